// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <numbers>

#include <cambium/kernels/constant_math.hpp>

namespace cambium {

/// Four-point delta function (1 + cos(pi x / 2)) / 4: the even-odd condition and the sum of squares 3/8 hold, the first
/// moment only nearly, so that interpolation is of first order (Peskin, J. Comput. Phys. 25 (1977) 220).
struct DeltaCosine {
  static constexpr int support = 4;
  static constexpr int moments = 0;
  static constexpr int continuity = 1;
  static constexpr bool interpolating = false;
  static constexpr bool even_odd = true;
  static constexpr double sum_of_squares = 0.375;

  template <std::floating_point T>
  static constexpr T value(T x) {
    const T r = x < T(0) ? -x : x;
    if (r >= T(2)) return T(0);
    return (T(1) + cosine(std::numbers::pi_v<T> / T(2) * r)) / T(4);
  }
};

}  // namespace cambium
