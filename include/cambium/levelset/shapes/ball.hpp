// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/levelset/shapes/shape.hpp>

namespace cambium {

/// A ball (in 2D a disk): the exact signed distance.
template <int D>
class Ball {
 public:
  static constexpr int dimension = D;
  static constexpr double lipschitz = 1.0;

  /// \throws ValueError unless the radius is positive and everything finite
  Ball(const Vec<D>& centre, double radius)
      : centre_(detail::finite(centre, "centre of the ball")),
        radius_(detail::positive_length(radius, "radius of the ball")) {}

  double operator()(const Vec<D>& x) const { return norm(x - centre_) - radius_; }
  Box<D> bounds() const { return detail::box_around(centre_, Vec<D>::constant(radius_)); }

 private:
  Vec<D> centre_;
  double radius_;
};

}  // namespace cambium
