// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

#include <cambium/levelset/geometry/surface_geometry.hpp>

namespace support {

/// q = sum_d (y_d / a_d)^2 - 1 with y = x - centre turned back by `angle` in the plane of axes 0 and 1.
template <int D>
struct Ellipsoid {
  cambium::Vec<D> semi_axes;
  cambium::Vec<D> centre;
  double angle = 0.0;

  static Ellipsoid ball(double radius, const cambium::Vec<D>& centre) {
    return {cambium::Vec<D>::constant(radius), centre};
  }
  /// Axis d of the body in space.
  cambium::Vec<D> axis(int d) const {
    cambium::Vec<D> e = cambium::Vec<D>::unit(d);
    if (d < 2) {
      e[0] = d == 0 ? std::cos(angle) : -std::sin(angle);
      e[1] = d == 0 ? std::sin(angle) : std::cos(angle);
    }
    return e;
  }
  cambium::Jet<double, D> operator()(const cambium::Vec<D>& x) const {
    cambium::Jet<double, D> jet;
    jet.value = -1.0;
    for (int d = 0; d < D; ++d) {
      const cambium::Vec<D> e = axis(d) / semi_axes[d];
      const double y = dot(x - centre, e);
      jet.value += y * y;
      jet.gradient += 2.0 * y * e;
      for (int i = 0; i < D; ++i) jet.hessian[i] += 2.0 * e[i] * e;
    }
    return jet;
  }
  cambium::SurfaceGeometry<double, D> geometry(const cambium::Vec<D>& x) const {
    return cambium::surface_geometry((*this)(x), 1.0);
  }
  /// q times a smooth factor that varies tenfold, from 1 to 10: the same interface, badly scaled.
  double badly_scaled(const cambium::Vec<D>& x) const {
    double wave = 1.0;
    for (int d = 0; d < D; ++d) wave *= std::sin((6.0 + d) * x[d] + 0.5 * d);
    return (*this)(x).value * (5.5 + 4.5 * wave);
  }
};

}  // namespace support
