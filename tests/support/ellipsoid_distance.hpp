// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <cambium/core/vec.hpp>

namespace support {

/// The signed distance of a point to an ellipse or ellipsoid, < 0 inside, and its closest point.
template <int D>
struct EllipsoidFoot {
  double distance;
  cambium::Vec<D> point;  ///< from the centre
};

/// The closest point is a^2 y / (t + a^2), t the largest root of sum (a y / (t + a^2))^2 = 1: by Newton's method from
/// below, which never passes the root of a convex, falling function. Exact as far inside as the point is unique.
///
/// \param y  from the centre
/// \param a  semi-axes
template <int D>
EllipsoidFoot<D> ellipsoid_foot(const cambium::Vec<D>& y, const cambium::Vec<D>& a) {
  double t = -std::numeric_limits<double>::infinity();
  for (int d = 0; d < D; ++d) t = std::max(t, a[d] * (std::abs(y[d]) - a[d]));  // a single term of the sum is 1 there
  for (int k = 0; k < 60; ++k) {
    double excess = -1.0, slope = 0.0;
    for (int d = 0; d < D; ++d) {
      const double below = t + a[d] * a[d];
      const double term = a[d] * y[d] / below;
      excess += term * term;
      slope -= 2.0 * term * term / below;
    }
    const double next = t - excess / slope;
    if (!(next > t)) break;
    t = next;
  }
  cambium::Vec<D> foot;
  double square = 0.0;
  for (int d = 0; d < D; ++d) {
    foot[d] = a[d] * a[d] * y[d] / (t + a[d] * a[d]);
    const double part = t * y[d] / (t + a[d] * a[d]);
    square += part * part;
  }
  return {std::copysign(std::sqrt(square), t), foot};
}

/// A smooth factor between 0.316 and 3.16: the distance times it has the same zero set, badly scaled.
template <int D>
double bad_scale(const cambium::Vec<D>& x) {
  double phase = 0.0;
  for (int d = 0; d < D; ++d) phase += (4.0 - d) * x[d] + d;
  return std::pow(10.0, 0.5 * std::sin(phase));
}

}  // namespace support
