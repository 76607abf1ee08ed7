// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <cambium/reaction/kinetics.hpp>
#include <cambium/reaction/polynomial_roots.hpp>

namespace cambium {

/// Activator c_1 and the substrate c_2 that it consumes (Koch & Meinhardt 1994; eq. 11.56 of Bergdorf, Milde &
/// Koumoutsakos):
///   F_1 = rho_1 P - mu_1 c_1 + sigma_1,   F_2 = -rho_2 P - mu_2 c_2 + sigma_2,   P = c_1^2 c_2 / (1 + kappa c_1^2)
/// Saturation kappa makes stripes of spots. mu_1 and rho_1, rho_2 are not zero.
struct KochMeinhardt {
  static constexpr int species = 2;

  double rho1, rho2;
  double mu1, mu2;
  double sigma1, sigma2;
  double kappa;

  template <class T>
  constexpr Vec<2, T> operator()(const Vec<2, T>& c) const {
    const T square = c[0] * c[0];
    const T production = square * c[1] / (T(1) + static_cast<T>(kappa) * square);
    return {static_cast<T>(rho1) * production - static_cast<T>(mu1) * c[0] + static_cast<T>(sigma1),
            -static_cast<T>(rho2) * production - static_cast<T>(mu2) * c[1] + static_cast<T>(sigma2)};
  }
  constexpr Jacobian<2> jacobian(const Vec<2>& c) const {
    const double square = c[0] * c[0], saturation = 1.0 + kappa * square;
    const Vec<2> gain{2.0 * c[0] * c[1] / (saturation * saturation), square / saturation};
    return {Vec<2>{rho1 * gain[0] - mu1, rho1 * gain[1]}, Vec<2>{-rho2 * gain[0], -rho2 * gain[1] - mu2}};
  }
  /// Uniform states: rho_2 F_1 + rho_1 F_2 = 0 gives P = (mu_1 c_1 - sigma_1) / rho_1 and c_2, or, without decay of the
  /// substrate, c_1 itself; else c_1 solves a cubic.
  std::vector<Vec<2>> fixed_points() const {
    std::vector<Vec<2>> result;
    if (mu2 == 0.0) {
      const double production = sigma2 / rho2;
      const double c = (rho1 * production + sigma1) / mu1;
      if (c != 0.0) result.push_back({c, production * (1.0 + kappa * c * c) / (c * c)});
      return result;
    }
    // c_2 = q - p c_1, and rho_1 c_1^2 c_2 = (mu_1 c_1 - sigma_1)(1 + kappa c_1^2).
    const double p = rho2 * mu1 / (rho1 * mu2), q = (sigma2 + rho2 * sigma1 / rho1) / mu2;
    const std::vector<double> cubic{sigma1, -mu1, rho1 * q + kappa * sigma1, -rho1 * p - kappa * mu1};
    for (const double c : real_roots(cubic)) result.push_back({c, q - p * c});
    return result;
  }
};

/// Parameters of Koch & Meinhardt (1994): rho_1 = mu_1 = 0.01, rho_2 = sigma_2 = 0.02, the others zero; without
/// saturation spots, with kappa = 0.25 stripes.
inline constexpr KochMeinhardt koch_meinhardt_spots{0.01, 0.02, 0.01, 0.0, 0.0, 0.02, 0.0};
inline constexpr KochMeinhardt koch_meinhardt_stripes{0.01, 0.02, 0.01, 0.0, 0.0, 0.02, 0.25};

/// Diffusivities of Koch & Meinhardt (1994), for lengths of about ten.
inline constexpr Vec<2> koch_meinhardt_diffusivities{0.005, 0.2};
/// The same over a thousand, for a sphere of radius 0.3 in a unit box: degrees 3 to 12 (spots) and 4 to 8 (stripes) are
/// unstable.
inline constexpr Vec<2> koch_meinhardt_unit_diffusivities{5e-6, 2e-4};

}  // namespace cambium
