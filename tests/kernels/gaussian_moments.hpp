// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace support {

/// integral over R^D of x^alpha pi^(-D/2) sum_k c_k rho^(2 k) exp(-rho^2), even alpha, in closed form.
///
/// Under the weight pi^(-D/2) exp(-rho^2) the components are independent with E[x_i^(2 m)] = (2 m - 1)!! / 2^m, and
/// rho^(2 k) is independent of the direction: E[x^alpha rho^(2 k)] = E[x^alpha] (D/2 + |alpha|/2)_k, with (a)_k = a (a
/// + 1)
/// ... (a + k - 1). For the kernels of the library every number on the way is a whole multiple of 2^-12 below 2^20: the
/// double arithmetic here is exact.
template <int D, std::size_t N>
double gaussian_moment(const std::array<double, N>& coefficient, const std::array<int, 3>& alpha) {
  double moment = 1.0;
  int degree = 0;
  for (int d = 0; d < D; ++d) {
    for (int i = alpha[d] - 1; i > 0; i -= 2) moment *= 0.5 * i;
    degree += alpha[d];
  }
  double sum = 0.0, rising = 1.0;
  for (std::size_t k = 0; k < N; ++k) {
    sum += coefficient[k] * rising;
    rising *= 0.5 * (D + degree) + static_cast<double>(k);
  }
  return moment * sum;
}

/// integral of a radial function f(rho) over the ball of a radius in R^D: Gauss's three-point rule on 500 intervals,
/// right to round-off for what varies over a length of 1.
template <int D, class F>
double radial_integral(const F& f, double radius) {
  const double pi = std::acos(-1.0);
  const double sphere = D == 1 ? 2.0 : D == 2 ? 2.0 * pi : 4.0 * pi;
  const double h = radius / 500;
  const double node[] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
  const double weight[] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  double sum = 0.0;
  for (int i = 0; i < 500; ++i) {
    for (int n = 0; n < 3; ++n) {
      const double rho = (i + node[n]) * h;
      sum += weight[n] * f(rho) * std::pow(rho, D - 1);
    }
  }
  return sphere * h * sum;
}

}  // namespace support
