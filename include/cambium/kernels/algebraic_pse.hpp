// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include <cambium/kernels/constant_math.hpp>

namespace cambium {

/// Algebraic kernel of particle strength exchange, of second order: eta = 16 / (pi^2 (rho^8 + 1)) in 2D and
/// 15 / (pi^2 (rho^10 + 1)) in 3D, eta_i = -(x_i / 2) eta.
///
/// No exponential to evaluate, but a wide foot and a Fourier transform that falls slowly: lattices must be finer than
/// for a Gaussian. A lattice sum has a relative error of the Laplacian of 4e-4 (2D) and 6e-4 (3D) at h / eps = 0.3, of
/// 2e-3 and 6e-3 at 0.4, of 8e-2 and 5e-2 at 0.8.
struct Algebraic2 {
  static constexpr int order = 2;
  /// The share of the second moment outside is 2 cutoff^-4 / pi = 6e-5 in 2D and 2 cutoff^-5 / pi = 6e-6 in 3D.
  static constexpr double cutoff = 10.0;
  static constexpr double largest_spacing = 0.3;
  /// 4 sqrt(2) in 2D, 24 / (1 + sqrt(5)) in 3D.
  template <int D>
  requires(D == 2 || D == 3) static constexpr double zeroth_moment = D == 2 ? 4.0 * std::numbers::sqrt2
                                                                            : 24.0 / (1.0 + square_root(5.0));

  template <int D>
  requires(D == 2 || D == 3) static constexpr double laplacian(double rho2) {
    constexpr double scale = std::numbers::inv_pi * std::numbers::inv_pi;
    const double rho8 = rho2 * rho2 * rho2 * rho2;
    return D == 2 ? 16.0 * scale / (rho8 + 1.0) : 15.0 * scale / (rho8 * rho2 + 1.0);
  }
  template <int D>
  requires(D == 2 || D == 3) static constexpr double gradient(double rho2) { return -0.5 * laplacian<D>(rho2); }
};

}  // namespace cambium
