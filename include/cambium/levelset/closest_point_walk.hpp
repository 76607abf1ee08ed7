// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/levelset/closest_points.hpp>

namespace cambium::detail {

/// Calls at(i, u) for every node i of block b with a closest point, u being that in spacings from entry 0 of `patch`,
/// which is read from `source` as far as stencils of kernel `Stencil` go; and without(i) for the other nodes.
template <class Stencil, class K, class T, int D, class Source, class Patch, class At, class Without>
void for_each_closest_point(const ClosestPoints<K, T, D>& points, const NarrowBand<T, D>& band, std::size_t b,
                            const Source& source, Patch& patch, At&& at, Without&& without) {
  PointBox<Stencil, T, D> box;
  for (std::size_t i = 0; i < NarrowBand<T, D>::volume; ++i) {
    if (points.found(b, i)) box.add(position_in_block<T, D>(i) + points.offset(b, i));
  }
  if (!box.empty()) box.read(source, band.values().block_origin(b), 0, patch);
  for (std::size_t i = 0; i < NarrowBand<T, D>::volume; ++i) {
    if (points.found(b, i)) {
      at(i, position_in_block<T, D>(i) + points.offset(b, i) - box.corner());
    } else {
      without(i);
    }
  }
}

}  // namespace cambium::detail
