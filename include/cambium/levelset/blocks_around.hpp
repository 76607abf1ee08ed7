// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <cambium/levelset/narrow_band.hpp>
#include <cambium/levelset/point_bins.hpp>

namespace cambium::detail {

/// Calls f(block, shift) for every stored block with nodes within `reach` nodes of block b; see for_each_block_within.
template <class T, int D, class F>
void for_each_block_around(const NarrowBand<T, D>& band, std::size_t b, std::ptrdiff_t reach, F&& f) {
  for_each_block_within(band.lattice(), band.values().block_index(b), reach,
                        [&](const Index<D>& block, const Index<D>& shift) {
                          const std::ptrdiff_t other = band.values().find(block);
                          if (other >= 0) f(static_cast<std::size_t>(other), shift);
                        });
}

}  // namespace cambium::detail
