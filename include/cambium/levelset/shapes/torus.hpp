// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/levelset/shapes/shape.hpp>

namespace cambium {

/// A ring torus: the exact signed distance.
class Torus {
 public:
  static constexpr int dimension = 3;
  static constexpr double lipschitz = 1.0;

  /// \param major  radius of the circle that the middle of the tube runs on
  /// \param minor  radius of the tube
  /// \param axis   normal of the plane of that circle, of any length
  /// \throws ValueError unless 0 < minor < major and everything is finite
  Torus(const Vec<3>& centre, double major, double minor, const Vec<3>& axis = {0.0, 0.0, 1.0})
      : centre_(detail::finite(centre, "centre of the torus")),
        axis_(detail::direction(axis, "axis of the torus")),
        major_(detail::positive_length(major, "major radius of the torus")),
        minor_(detail::positive_length(minor, "minor radius of the torus")) {
    if (!(minor < major)) {
      throw ValueError(detail::message("the tube of the torus has radius ", minor, " and runs on a circle of radius ",
                                       major, ": it must be the thinner one"));
    }
  }

  double operator()(const Vec<3>& x) const {
    const Vec<3> p = x - centre_;
    const double along = dot(p, axis_);
    const double across = norm(p - along * axis_);
    return std::sqrt((across - major_) * (across - major_) + along * along) - minor_;
  }
  Box<3> bounds() const {
    Vec<3> half;
    for (int d = 0; d < 3; ++d) half[d] = major_ * std::sqrt(std::fmax(1.0 - axis_[d] * axis_[d], 0.0)) + minor_;
    return detail::box_around(centre_, half);
  }

 private:
  Vec<3> centre_;
  Vec<3> axis_;
  double major_;
  double minor_;
};

}  // namespace cambium
