// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include <cambium/levelset/shapes/shape.hpp>

namespace cambium {

/// An ellipsoid (in 2D an ellipse) with its axes along those of the lattice.
///
/// Not the distance: min(a) (|(x - centre) / a| - 1) with the half axes a, which is exact for a ball, below the
/// distance elsewhere and smooth but at the centre. Its slope at the surface is between min(a) / max(a) and 1.
template <int D>
class Ellipsoid {
 public:
  static constexpr int dimension = D;
  static constexpr double lipschitz = 1.0;

  /// \throws ValueError unless the half axes are positive and everything finite
  Ellipsoid(const Vec<D>& centre, const Vec<D>& half_axes)
      : centre_(detail::finite(centre, "centre of the ellipsoid")), half_axes_(half_axes) {
    for (int d = 0; d < D; ++d) detail::positive_length(half_axes[d], "half axis of the ellipsoid");
    shortest_ = *std::min_element(half_axes_.component, half_axes_.component + D);
  }

  double operator()(const Vec<D>& x) const {
    Vec<D> scaled;
    for (int d = 0; d < D; ++d) scaled[d] = (x[d] - centre_[d]) / half_axes_[d];
    return shortest_ * (norm(scaled) - 1.0);
  }
  Box<D> bounds() const { return detail::box_around(centre_, half_axes_); }

 private:
  Vec<D> centre_;
  Vec<D> half_axes_;
  double shortest_;
};

}  // namespace cambium
