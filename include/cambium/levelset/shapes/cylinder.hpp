// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <cambium/levelset/shapes/shape.hpp>

namespace cambium {

/// A finite cylinder with flat ends between two points (in 2D a rectangle around a segment): the exact signed distance.
template <int D>
class Cylinder {
 public:
  static constexpr int dimension = D;
  static constexpr double lipschitz = 1.0;

  /// \param from, to  middles of the two ends
  /// \throws ValueError unless the radius is positive, the ends differ and everything is finite
  Cylinder(const Vec<D>& from, const Vec<D>& to, double radius)
      : middle_((detail::finite(from, "end of the cylinder") + detail::finite(to, "end of the cylinder")) * 0.5),
        axis_(detail::direction(to - from, "axis of the cylinder")),
        half_length_(0.5 * norm(to - from)),
        radius_(detail::positive_length(radius, "radius of the cylinder")) {}

  double operator()(const Vec<D>& x) const {
    const Vec<D> p = x - middle_;
    const double along = dot(p, axis_);
    const double beyond_end = std::abs(along) - half_length_;
    const double beyond_side = norm(p - along * axis_) - radius_;
    if (beyond_end <= 0.0 || beyond_side <= 0.0) return std::max(beyond_end, beyond_side);
    return std::sqrt(beyond_end * beyond_end + beyond_side * beyond_side);
  }
  Box<D> bounds() const {
    Vec<D> half;
    for (int d = 0; d < D; ++d) {
      half[d] = half_length_ * std::abs(axis_[d]) + radius_ * std::sqrt(std::fmax(1.0 - axis_[d] * axis_[d], 0.0));
    }
    return detail::box_around(middle_, half);
  }

 private:
  Vec<D> middle_;
  Vec<D> axis_;
  double half_length_;
  double radius_;
};

}  // namespace cambium
