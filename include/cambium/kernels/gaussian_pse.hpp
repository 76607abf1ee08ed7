// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include <cambium/kernels/radial_gaussian.hpp>

namespace cambium {

/// Gaussian kernel of particle strength exchange, of order 2, 4 or 6 in D = 1, 2, 3, with n = Order/2 - 1:
///   eta(x) = 4 pi^(-D/2) L_n^(D/2 + 1)(rho^2) exp(-rho^2),   eta_i(x) = -(x_i / 2) eta(x).
/// Orthogonality of the Laguerre polynomials with weight u^(D/2 + 1) exp(-u), u = rho^2, gives the moments.
///
/// Leading errors: Lap + (-1)^n eps^(2n+2) / (4^(n+1) (n+2)!) Lap^(n+2), and for d_i the same with (n+1)! and
/// d_i Lap^(n+1). A sum over a lattice of spacing h adds a relative error of the Laplacian that does not fall with eps:
///   h / eps   order 2    order 4    order 6
///   0.5       -1e-15     -4e-14     -9e-13
///   0.6       -1.3e-10   -3.7e-09   -5.0e-08
///   0.8       -1.2e-05   -1.8e-04   -1.4e-03
///   1.0       -1.9e-03   -1.9e-02   -9.3e-02
template <int Order>
struct GaussianPSE {
  static_assert(Order == 2 || Order == 4 || Order == 6, "cambium::GaussianPSE: the order must be 2, 4 or 6");
  static constexpr int order = Order;
  /// From here on |eta| is below 1e-16 of eta(0), in every dimension.
  static constexpr double cutoff = Order == 2 ? 6.2 : Order == 4 ? 6.5 : 6.8;
  static constexpr double largest_spacing = Order == 2 ? 0.8 : Order == 4 ? 0.6 : 0.5;
  template <int D>
  static constexpr double zeroth_moment = 2.0 * Order;

  /// c_k in eta = pi^(-D/2) sum_k c_k rho^(2 k) exp(-rho^2); exact.
  template <int D>
  static constexpr auto polynomial = [] {
    auto c = detail::laguerre<Order / 2 - 1>(0.5 * D + 1.0);
    for (double& coefficient : c) coefficient *= 4.0;
    return c;
  }();

  /// eta at distance rho, given rho^2.
  template <int D>
  static constexpr double laplacian(double rho2) {
    return detail::radial_gaussian<D>(polynomial<D>, rho2);
  }
  /// g at distance rho, given rho^2; eta_i = x_i g.
  template <int D>
  static constexpr double gradient(double rho2) {
    return -0.5 * laplacian<D>(rho2);
  }
};

using Gaussian2 = GaussianPSE<2>;
using Gaussian4 = GaussianPSE<4>;
using Gaussian6 = GaussianPSE<6>;

}  // namespace cambium
