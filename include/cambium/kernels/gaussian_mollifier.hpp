// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/core/vec.hpp>
#include <cambium/kernels/radial_gaussian.hpp>

namespace cambium {

/// Gaussian mollifier of order 2, 4 or 6 in D = 1, 2, 3: zeta(x) = pi^(-D/2) L_n^(D/2)(rho^2) exp(-rho^2), n = Order/2
/// - 1, with L_n^(a) the generalised Laguerre polynomial. Its orthogonality with weight u^(D/2) exp(-u), u = rho^2,
/// makes the moments of degree 1, ..., Order - 1 vanish. Above order 2 it takes both signs.
template <int Order>
struct GaussianMollifier {
  static_assert(Order == 2 || Order == 4 || Order == 6, "cambium::GaussianMollifier: the order must be 2, 4 or 6");
  static constexpr int order = Order;
  /// From here on |zeta| is below 1e-16 of zeta(0), in every dimension.
  static constexpr double cutoff = Order == 2 ? 6.2 : Order == 4 ? 6.5 : 6.8;

  /// c_k in zeta = pi^(-D/2) sum_k c_k rho^(2 k) exp(-rho^2); exact.
  template <int D>
  static constexpr auto polynomial = detail::laguerre<Order / 2 - 1>(0.5 * D);

  /// zeta at distance rho, given rho^2.
  template <int D>
  static constexpr double radial(double rho2) {
    return detail::radial_gaussian<D>(polynomial<D>, rho2);
  }
  /// zeta(x)
  template <int D>
  static constexpr double value(const Vec<D>& x) {
    return radial<D>(dot(x, x));
  }
};

}  // namespace cambium
