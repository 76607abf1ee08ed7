// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <cambium/levelset/geometry/surface_geometry.hpp>

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

  /// The closest point is a^2 y / (t + a^2), y = x - centre, t the largest root of sum (a y / (t + a^2))^2 = 1: by
  /// Newton's method from below, which never passes the root of a convex, falling function.
  Point operator()(const cambium::Vec<D>& x) const {
    const cambium::Vec<D> y = x - centre;
    double t = -std::numeric_limits<double>::infinity();
    for (int d = 0; d < D; ++d) t = std::max(t, half_axes[d] * (std::abs(y[d]) - half_axes[d]));
    for (int k = 0; k < 60; ++k) {
      double excess = -1.0, slope = 0.0;
      for (int d = 0; d < D; ++d) {
        const double below = t + half_axes[d] * half_axes[d];
        const double term = half_axes[d] * y[d] / below;
        excess += term * term;
        slope -= 2.0 * term * term / below;
      }
      const double next = t - excess / slope;
      if (!(next > t)) break;
      t = next;
    }
    cambium::Vec<D> on;
    for (int d = 0; d < D; ++d) on[d] = half_axes[d] * half_axes[d] * y[d] / (t + half_axes[d] * half_axes[d]);
    const double distance = std::copysign(norm(on - y), t);
    // Principal curvatures k of the surface become k / (1 + k distance).
    const auto geometry = surface(on);
    const double mean = geometry.mean, product = geometry.gaussian;
    const double stretch = 1.0 + distance * (mean + distance * product);
    return {distance, mean, (mean + 2.0 * distance * product) / stretch};
  }
  /// A function of the same zero set, badly scaled: the distance times a smooth factor from 0.32 to 3.2.
  double badly_scaled(const cambium::Vec<D>& x, double distance) const {
    double phase = 0.0;
    for (int d = 0; d < D; ++d) phase += (4.0 - d) * x[d] + d;
    return distance * std::pow(10.0, 0.5 * std::sin(phase));
  }

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
