// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <cambium/levelset/shapes/shape.hpp>

namespace cambium {

/// Two balls of one radius joined by a straight neck: the exact signed distance. Where the neck meets the balls there
/// is a sharp crease; blend(ball, neck, ball) makes a smooth one.
template <int D>
class Dumbbell {
 public:
  static constexpr int dimension = D;
  static constexpr double lipschitz = 1.0;

  /// \param a, b  centres of the balls
  /// \throws ValueError unless 0 < neck < radius, the balls are apart by more than their junctions with the neck, and
  ///         everything is finite
  Dumbbell(const Vec<D>& a, const Vec<D>& b, double radius, double neck)
      : middle_((detail::finite(a, "centre of the dumbbell") + detail::finite(b, "centre of the dumbbell")) * 0.5),
        axis_(detail::direction(b - a, "axis of the dumbbell")),
        half_length_(0.5 * norm(b - a)),
        radius_(detail::positive_length(radius, "radius of the dumbbell's balls")),
        neck_(detail::positive_length(neck, "radius of the dumbbell's neck")) {
    const double within = std::sqrt(std::fmax(radius * radius - neck * neck, 0.0));
    junction_ = half_length_ - within;
    if (!(neck < radius && junction_ > 0.0)) {
      throw ValueError(detail::message("a dumbbell of balls of radius ", radius, " whose centres are ",
                                       2.0 * half_length_, " apart has no neck of radius ", neck,
                                       ": move the balls apart or make the neck thinner"));
    }
  }

  /// In the half plane of the axis and the distance from it, mirrored: an arc, a segment, and the point they share.
  double operator()(const Vec<D>& x) const {
    const Vec<D> p = x - middle_;
    const double signed_along = dot(p, axis_);
    const double along = std::abs(signed_along) - half_length_;
    const double across = norm(p - signed_along * axis_);
    const double from_centre = std::hypot(along, across);
    double distance = std::hypot(along + half_length_ - junction_, across - neck_);
    const bool faces_arc = along * neck_ >= across * (junction_ - half_length_);
    if (faces_arc) distance = std::min(distance, std::abs(from_centre - radius_));
    const bool faces_neck = along + half_length_ <= junction_;
    if (faces_neck) distance = std::min(distance, std::abs(across - neck_));
    const bool inside = from_centre < radius_ || (across < neck_ && along < 0.0);
    return inside ? -distance : distance;
  }
  Box<D> bounds() const {
    Vec<D> half;
    for (int d = 0; d < D; ++d) half[d] = half_length_ * std::abs(axis_[d]) + radius_;
    return detail::box_around(middle_, half);
  }

 private:
  Vec<D> middle_;
  Vec<D> axis_;
  double half_length_;
  double radius_;
  double neck_;
  double junction_ = 0.0;
};

}  // namespace cambium
