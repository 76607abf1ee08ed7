// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include <cambium/reaction/kinetics.hpp>

namespace cambium {

/// The linear kinetics with quadratic and cubic saturation of Barrio, Varea, Aragon & Maini (1999) that Varea et al.
/// put on spheres (eq. 11.55 of Bergdorf, Milde & Koumoutsakos, with the signs below):
///   F_1 = alpha c_1 (1 - r_1 c_2^2) + c_2 (1 - r_2 c_1)
///   F_2 = beta c_2 (1 + alpha r_1 / beta c_1 c_2) + c_1 (gamma + r_2 c_2)
/// r_1 favours stripes, r_2 spots. With gamma = -alpha the origin is the only uniform state. The sign of r_2 in the
/// second line is + : with a minus there is a second uniform state that is a saddle, and everything grows without
/// bound.
struct LinearisedBrusselator {
  static constexpr int species = 2;

  double alpha;
  double beta;
  double gamma;
  double r1;
  double r2;

  template <class T>
  constexpr Vec<2, T> operator()(const Vec<2, T>& c) const {
    const T a = static_cast<T>(alpha), b = static_cast<T>(beta), g = static_cast<T>(gamma);
    const T cubic = a * static_cast<T>(r1) * c[0] * c[1] * c[1];
    const T square = static_cast<T>(r2) * c[0] * c[1];
    return {a * c[0] + c[1] - square - cubic, g * c[0] + b * c[1] + square + cubic};
  }
  constexpr Jacobian<2> jacobian(const Vec<2>& c) const {
    const Vec<2> gain{alpha * r1 * c[1] * c[1] + r2 * c[1], 2.0 * alpha * r1 * c[0] * c[1] + r2 * c[0]};
    return {Vec<2>{alpha - gain[0], 1.0 - gain[1]}, Vec<2>{gamma + gain[0], beta + gain[1]}};
  }
  /// The origin and, unless gamma = -alpha, those on c_2 = m c_1, m = -(alpha + gamma) / (1 + beta), where the rates
  /// add up to zero; beta is not -1.
  std::vector<Vec<2>> fixed_points() const {
    std::vector<Vec<2>> result{{0.0, 0.0}};
    const double m = -(alpha + gamma) / (1.0 + beta);
    if (m == 0.0) return result;
    // alpha + m - r_2 m c_1 - alpha r_1 m^2 c_1^2 = 0
    const double square = -alpha * r1 * m * m, linear = -r2 * m, constant = alpha + m;
    const double under = linear * linear - 4.0 * square * constant;
    if (square == 0.0) {
      if (linear != 0.0) result.push_back({-constant / linear, -constant / linear * m});
    } else if (under >= 0.0) {
      for (const double sign : {-1.0, 1.0}) {
        const double c = (-linear + sign * std::sqrt(under)) / (2.0 * square);
        result.push_back({c, m * c});
      }
    }
    return result;
  }
};

/// Spots: alpha = 0.899, beta = -0.91, gamma = -alpha, r_1 = 0.02, r_2 = 0.2 (Varea, Aragon & Barrio 1999).
inline constexpr LinearisedBrusselator varea_spots{0.899, -0.91, -0.899, 0.02, 0.2};

/// Diffusivities of six spots on a sphere of radius 2, where degree l = 4 alone is unstable: 0.516 is the ratio of the
/// two, and delta = 0.088 the larger one.
inline constexpr Vec<2> varea_diffusivities{0.516 * 0.088, 0.088};
/// Diffusivities as printed in Bergdorf, Milde & Koumoutsakos: on the unit sphere l = 1 and 2 are unstable.
inline constexpr Vec<2> varea_printed_diffusivities{0.088, 0.516};

}  // namespace cambium
