// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/levelset/shapes/shape.hpp>

namespace cambium {

/// All points behind a plane (in 2D a line): the exact signed distance. For cutting other shapes.
template <int D>
class HalfSpace {
 public:
  static constexpr int dimension = D;
  static constexpr double lipschitz = 1.0;

  /// \param normal  points outward, of any length. \throws ValueError if it has no direction
  HalfSpace(const Vec<D>& point, const Vec<D>& normal)
      : point_(detail::finite(point, "point of the half space")),
        normal_(detail::direction(normal, "normal of the half space")) {}

  double operator()(const Vec<D>& x) const { return dot(x - point_, normal_); }
  Box<D> bounds() const { return detail::everywhere<D>(); }

 private:
  Vec<D> point_;
  Vec<D> normal_;
};

/// All points between two parallel planes: the exact signed distance.
template <int D>
class Slab {
 public:
  static constexpr int dimension = D;
  static constexpr double lipschitz = 1.0;

  /// \param point      half way between the planes
  /// \param thickness  from plane to plane. \throws ValueError unless it is positive and the normal has a direction
  Slab(const Vec<D>& point, const Vec<D>& normal, double thickness)
      : point_(detail::finite(point, "point of the slab")),
        normal_(detail::direction(normal, "normal of the slab")),
        half_(0.5 * detail::positive_length(thickness, "thickness of the slab")) {}

  double operator()(const Vec<D>& x) const { return std::abs(dot(x - point_, normal_)) - half_; }
  Box<D> bounds() const { return detail::everywhere<D>(); }

 private:
  Vec<D> point_;
  Vec<D> normal_;
  double half_;
};

}  // namespace cambium
