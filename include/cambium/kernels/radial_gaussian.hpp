// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <numbers>

#include <cambium/kernels/constant_math.hpp>

namespace cambium::detail {

/// pi^(-D/2)
template <int D>
constexpr double gaussian_norm() {
  double result = 1.0;
  for (int d = 0; d < D; ++d) result *= std::numbers::inv_sqrtpi;
  return result;
}

/// Coefficients of u^0, ..., u^N in the generalised Laguerre polynomial L_N^(a)(u) = sum_k C(N + a, N - k) (-u)^k / k!.
/// For N <= 2 and whole or half a they are multiples of 1/8: exact.
template <int N>
constexpr std::array<double, N + 1> laguerre(double a) {
  std::array<double, N + 1> coefficient{};
  for (int k = 0; k <= N; ++k) {
    coefficient[k] = k % 2 == 0 ? 1.0 : -1.0;
    for (int i = 1; i <= N - k; ++i) coefficient[k] *= (a + k + i) / i;
    for (int i = 1; i <= k; ++i) coefficient[k] /= i;
  }
  return coefficient;
}

/// pi^(-D/2) sum_k c_k u^k exp(-u), u = rho^2
template <int D, std::size_t N>
constexpr double radial_gaussian(const std::array<double, N>& coefficient, double u) {
  double sum = 0.0;
  for (std::size_t k = N; k-- > 0;) sum = sum * u + coefficient[k];
  return gaussian_norm<D>() * sum * exponential(-u);
}

}  // namespace cambium::detail
