// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <numbers>

namespace cambium::detail {

/// Moments M_m = integral over R^D of rho^(2 m) f(rho^2), m = 0, 1, ..., and the integral of rho^2 |f| outside a ball.
template <std::size_t Count>
struct RadialMoments {
  std::array<double, Count> moment{};
  double outside = 0.0;
};

/// Trapezoidal rule in ln rho with step 1/8 from e^-16 to e^8. For integrands that are analytic in ln rho it converges
/// exponentially: to 1e-12 for Gaussians, 1e-7 for 1/(rho^10 + 1); what lies below e^-16 is 1e-7 of f(0) in 1D.
template <int D, std::size_t Count, class F>
constexpr RadialMoments<Count> radial_moments(const F& f, double radius) {
  constexpr double step = 0.125;
  constexpr double factor = 1.1331484530668263168;  // e^(1/8)
  constexpr double sphere = D == 1 ? 2.0 : (D == 2 ? 2.0 : 4.0) * std::numbers::pi;
  RadialMoments<Count> result;
  double rho = 1.1253517471925911e-7;  // e^-16
  for (int k = -128; k <= 64; ++k, rho *= factor) {
    double weighted = f(rho * rho) * sphere * step;
    for (int d = 0; d < D; ++d) weighted *= rho;
    if (rho > radius) result.outside += rho * rho * (weighted < 0.0 ? -weighted : weighted);
    for (std::size_t m = 0; m < Count; ++m) {
      result.moment[m] += weighted;
      weighted *= rho * rho;
    }
  }
  return result;
}

/// Tolerance of a compile-time check of moments by radial_moments().
inline constexpr double radial_tolerance = 1e-5;

constexpr bool nearly(double found, double expected) {
  const double difference = found < expected ? expected - found : found - expected;
  return difference <= radial_tolerance * (1.0 + (expected < 0.0 ? -expected : expected));
}

}  // namespace cambium::detail
