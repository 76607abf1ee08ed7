// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>

#include <cambium/levelset/patch.hpp>

namespace cambium::detail {

/// True if the values of a patch have both signs.
template <class T, int D>
bool has_both_signs(const Patch<T, D>& patch) {
  std::ptrdiff_t negative = 0;
  const std::ptrdiff_t size = product(patch.edge());
  for (std::ptrdiff_t at = 0; at < size; ++at) negative += patch[at] < T(0);
  return negative > 0 && negative < size;
}

/// The linear estimate of the closest point from the crossings of the lattice lines through a node: the foot of the
/// perpendicular on the plane through them. \return false if no line crosses
template <class T, int D>
bool crossing(const Patch<T, D>& patch, std::ptrdiff_t at, Vec<D, T>& offset) {
  const T here = patch[at];
  Vec<D, T> inverse{};
  bool crossed = false;
  for (int d = 0; d < D; ++d) {
    for (const int way : {-1, 1}) {
      const T there = patch[at + way * patch.stride()[d]];
      if ((here < T(0)) == (there < T(0))) continue;
      crossed = true;
      const T slope = static_cast<T>(way) * (here - there);
      if (std::abs(slope) > std::abs(inverse[d] * here)) inverse[d] = slope / here;
    }
  }
  if (crossed) offset = here == T(0) ? Vec<D, T>{} : inverse / dot(inverse, inverse);
  return crossed;
}

}  // namespace cambium::detail
