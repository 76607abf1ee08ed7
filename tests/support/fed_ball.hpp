// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/core/lattice.hpp>
#include <cambium/core/vec.hpp>

namespace support {

/// A ball of tissue of radius R fed from outside: Lap c = c inside, c = 1 outside; -Lap p = G (c - A) inside;
/// p_in - p_out = gamma kappa. It grows with V = -dp/dn, the same with p = 0 outside and in free space, where dp/dn
/// does not jump: that is what comes of the source inside.
template <int D>
struct FedBall {
  using Vec = cambium::Vec<D>;
  static constexpr double radius = 2.0;
  static constexpr double growth = 20.0;  ///< G
  static constexpr double decay = 0.5;    ///< A
  static constexpr double tension = 1.0;  ///< gamma
  static constexpr double surface_pressure = tension * (D - 1) / radius;

  static Vec centre() { return Vec::constant(0.02) + Vec::unit(0, 0.05); }
  static cambium::Lattice<D> lattice(std::ptrdiff_t cells) {
    return cambium::Lattice<D>::bounded_box({Vec::constant(-3.0), Vec::constant(3.0)}, cells);
  }
  /// Regular radial solution of Lap c = c.
  static double regular(double r) {
    if constexpr (D == 2) return std::cyl_bessel_i(0.0, r);
    return r < 1e-3 ? 1.0 + r * r / 6.0 : std::sinh(r) / r;
  }
  static double nutrient(const Vec& x) { return regular(norm(x - centre())) / regular(radius); }
  static double source(const Vec& x) { return growth * (nutrient(x) - decay); }
  /// p inside if it is zero outside.
  static double pressure(const Vec& x) {
    const Vec y = x - centre();
    return surface_pressure + growth * (1.0 - nutrient(x)) - growth * decay * (radius * radius - dot(y, y)) / (2.0 * D);
  }
  /// p in free space, where -dp/dn does not jump; in the plane but for a constant.
  static double free_pressure(bool inside, const Vec& x) {
    const double r = norm(x - centre());
    const auto beyond = [](double q) { return D == 2 ? -std::log(q / radius) : radius / q; };
    return inside ? pressure(x) + speed() * radius * beyond(radius) : speed() * radius * beyond(r);
  }
  /// R^{1 - D} times the integral of G (c - A) r^{D - 1} from 0 to R.
  static double speed() {
    const double fed = D == 2 ? std::cyl_bessel_i(1.0, radius) / std::cyl_bessel_i(0.0, radius)
                              : 1.0 / std::tanh(radius) - 1.0 / radius;
    return growth * (fed - decay * radius / D);
  }
};

}  // namespace support
