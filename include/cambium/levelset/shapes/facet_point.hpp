// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <cambium/core/vec.hpp>

namespace cambium::detail {

/// The point of a facet nearest to a position, and the part of the facet that it lies on.
template <int D>
struct FacetPoint {
  Vec<D> point;
  int corner = -1;    ///< the corner that it is
  int opposite = -1;  ///< of a triangle: the corner opposite to the edge that it lies on
};

template <int D>
using FacetCorners = std::array<Vec<D>, static_cast<std::size_t>(D)>;

inline FacetPoint<2> nearest_on_facet(const FacetCorners<2>& corners, const Vec<2>& x) {
  const Vec<2> along = corners[1] - corners[0];
  const double t = dot(x - corners[0], along) / dot(along, along);
  if (!(t > 0.0)) return {corners[0], 0, -1};
  if (!(t < 1.0)) return {corners[1], 1, -1};
  return {corners[0] + t * along, -1, -1};
}

/// By the signs of barycentric coordinates (Ericson 2005, Real-Time Collision Detection, section 5.1.5).
inline FacetPoint<3> nearest_on_facet(const FacetCorners<3>& corners, const Vec<3>& x) {
  const Vec<3> ab = corners[1] - corners[0];
  const Vec<3> ac = corners[2] - corners[0];
  const double a1 = dot(ab, x - corners[0]), a2 = dot(ac, x - corners[0]);
  if (a1 <= 0.0 && a2 <= 0.0) return {corners[0], 0, -1};
  const double b1 = dot(ab, x - corners[1]), b2 = dot(ac, x - corners[1]);
  if (b1 >= 0.0 && b2 <= b1) return {corners[1], 1, -1};
  const double c1 = dot(ab, x - corners[2]), c2 = dot(ac, x - corners[2]);
  if (c2 >= 0.0 && c1 <= c2) return {corners[2], 2, -1};
  const double wc = a1 * b2 - b1 * a2;
  if (wc <= 0.0 && a1 >= 0.0 && b1 <= 0.0) return {corners[0] + a1 / (a1 - b1) * ab, -1, 2};
  const double wb = c1 * a2 - a1 * c2;
  if (wb <= 0.0 && a2 >= 0.0 && c2 <= 0.0) return {corners[0] + a2 / (a2 - c2) * ac, -1, 1};
  const double wa = b1 * c2 - c1 * b2;
  if (wa <= 0.0 && b2 >= b1 && c1 >= c2) {
    return {corners[1] + (b2 - b1) / ((b2 - b1) + (c1 - c2)) * (corners[2] - corners[1]), -1, 0};
  }
  const double sum = wa + wb + wc;
  return {corners[0] + wb / sum * ab + wc / sum * ac, -1, -1};
}

}  // namespace cambium::detail
