// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <concepts>

#include <cambium/kernels/constant_math.hpp>

namespace cambium {

/// Six-point delta function close to a Gaussian (Bao, Kaye & Peskin, J. Comput. Phys. 316 (2016) 139).
///
/// The even-odd condition and the moments 0, K, 0 of degrees 1, 2, 3 leave one free value, phi(r - 3) =: q for r in
/// [0, 1]; the sum of squares, fixed by phi(-3) = 0, is the quadratic 28 q^2 + beta(r) q + gamma(r) = 0. The value of
/// the second moment K makes phi three times continuously differentiable.
struct Delta6 {
  static constexpr int support = 6;
  static constexpr int moments = 1;
  static constexpr int continuity = 3;
  static constexpr bool interpolating = false;
  static constexpr bool even_odd = true;
  static constexpr double second_moment = 59.0 / 60.0 - square_root(29.0) / 20.0;
  static constexpr double sum_of_squares =
      67.0 / 128.0 - 11.0 / 32.0 * second_moment + 3.0 / 32.0 * second_moment * second_moment;
  static constexpr std::array<double, 4> constant_moments{1.0, 0.0, second_moment, 0.0};

  template <std::floating_point T>
  static constexpr T value(T x) {
    constexpr T K = static_cast<T>(59) / T(60) - square_root(static_cast<T>(29)) / T(20);
    const T distance = x < T(0) ? -x : x;
    if (distance >= T(3)) return T(0);
    const int cell = distance >= T(2) ? 2 : distance >= T(1) ? 1 : 0;
    const T r = distance - T(cell);
    const T r2 = r * r;
    const T beta = (T(27) - T(18) * (K + r2) + (T(88) - T(84) * K - T(28) * r2) * r) / T(12);
    const T gamma = r2 * (T(161) - T(354) * K + T(180) * K * K + (T(120) * K - T(109)) * r2 + T(20) * r2 * r2) / T(288);
    const T q = (square_root(beta * beta - T(112) * gamma) - beta) / T(56);
    if (cell == 0) return T(2) * q + T(5) / T(8) - (K + r2) / T(4);
    if (cell == 1) return T(-3) * q + T(1) / T(4) + (T(3) * K - T(4) + r2) * r / T(6);
    return q - T(1) / T(16) + (K + r2) / T(8) - (T(3) * K - T(1) + r2) * r / T(12);
  }
};

}  // namespace cambium
