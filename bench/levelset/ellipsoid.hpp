// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/levelset/geometry/surface_geometry.hpp>

#include "support/ellipsoid_distance.hpp"

namespace bench {

/// An ellipse or ellipsoid off symmetric places, with what is known of it exactly.
template <int D>
struct Body {
  cambium::Vec<D> centre = place({0.513, 0.4929, 0.5037});
  cambium::Vec<D> half_axes = place({0.36, 0.3, 0.27});

  /// Signed distance of a point, the curvature of the surface at its closest point and that of the level surface
  /// through it.
  struct Point {
    double distance;
    double of_surface;
    double of_level;
  };

  Point operator()(const cambium::Vec<D>& x) const {
    const auto [distance, foot] = support::ellipsoid_foot(x - centre, half_axes);
    // Principal curvatures k of the surface become k / (1 + k distance).
    const auto geometry = surface(foot);
    const double mean = geometry.mean, product = geometry.gaussian;
    const double stretch = 1.0 + distance * (mean + distance * product);
    return {distance, mean, (mean + 2.0 * distance * product) / stretch};
  }
  /// A function of the same zero set, badly scaled: the distance times a smooth factor from 0.316 to 3.16.
  double badly_scaled(const cambium::Vec<D>& x, double distance) const { return distance * support::bad_scale(x); }

 private:
  static cambium::Vec<D> place(const cambium::Vec<3>& first) {
    cambium::Vec<D> result;
    for (int d = 0; d < D; ++d) result[d] = first[d];
    return result;
  }
  /// \param y  a point of the surface, from the centre
  cambium::SurfaceGeometry<double, D> surface(const cambium::Vec<D>& y) const {
    cambium::Jet<double, D> quadric;
    for (int d = 0; d < D; ++d) {
      quadric.gradient[d] = 2.0 * y[d] / (half_axes[d] * half_axes[d]);
      quadric.hessian[d][d] = 2.0 / (half_axes[d] * half_axes[d]);
    }
    return cambium::surface_geometry(quadric, 1.0);
  }
};

}  // namespace bench
