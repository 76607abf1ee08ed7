// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>

#include <cambium/kernels/constant_math.hpp>

namespace cambium {

/// Four-point delta function from the even-odd condition, the first moment and the sum of squares 3/8 (Peskin, Acta
/// Numerica 11 (2002) 479, eq. 6.27).
struct Delta4 {
  static constexpr int support = 4;
  static constexpr int moments = 1;
  static constexpr int continuity = 1;
  static constexpr bool interpolating = false;
  static constexpr bool even_odd = true;
  static constexpr double sum_of_squares = 0.375;

  template <std::floating_point T>
  static constexpr T value(T x) {
    const T r = x < T(0) ? -x : x;
    if (r >= T(2)) return T(0);
    if (r > T(1)) return (T(5) - T(2) * r - square_root(T(12) * r - T(7) - T(4) * r * r)) / T(8);
    return (T(3) - T(2) * r + square_root(T(1) + T(4) * r - T(4) * r * r)) / T(8);
  }
};

}  // namespace cambium
