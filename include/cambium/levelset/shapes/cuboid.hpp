// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <cambium/levelset/shapes/shape.hpp>

namespace cambium {

/// A box as a shape (Box is the geometry alone), its faces normal to the axes: the exact signed distance.
template <int D>
class Cuboid {
 public:
  static constexpr int dimension = D;
  static constexpr double lipschitz = 1.0;

  /// \throws ValueError unless lo < hi along every axis and everything is finite
  explicit Cuboid(const Box<D>& box) : centre_(detail::finite(box.centre(), "centre of the cuboid")) {
    for (int d = 0; d < D; ++d) half_[d] = detail::positive_length(0.5 * box.extent()[d], "half edge of the cuboid");
  }

  double operator()(const Vec<D>& x) const {
    double outside = 0.0;
    double inside = -std::numeric_limits<double>::infinity();
    for (int d = 0; d < D; ++d) {
      const double beyond = std::abs(x[d] - centre_[d]) - half_[d];
      outside += beyond > 0.0 ? beyond * beyond : 0.0;
      inside = std::max(inside, beyond);
    }
    return inside > 0.0 ? std::sqrt(outside) : inside;
  }
  Box<D> bounds() const { return detail::box_around(centre_, half_); }

 private:
  Vec<D> centre_;
  Vec<D> half_;
};

}  // namespace cambium
