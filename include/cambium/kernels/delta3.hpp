// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>

#include <cambium/kernels/constant_math.hpp>

namespace cambium {

/// Three-point delta function: first moment and sum of squares do not depend on the lattice; for staggered lattices,
/// since it has no even-odd condition (Roma, Peskin & Berger, J. Comput. Phys. 153 (1999) 509).
struct Delta3 {
  static constexpr int support = 3;
  static constexpr int moments = 1;
  static constexpr int continuity = 1;
  static constexpr bool interpolating = false;
  static constexpr bool even_odd = false;
  static constexpr double sum_of_squares = 0.5;

  template <std::floating_point T>
  static constexpr T value(T x) {
    const T r = x < T(0) ? -x : x;
    if (r >= T(1.5)) return T(0);
    if (r > T(0.5)) return (T(5) - T(3) * r - square_root(T(1) - T(3) * (T(1) - r) * (T(1) - r))) / T(6);
    return (T(1) + square_root(T(1) - T(3) * r * r)) / T(3);
  }
};

}  // namespace cambium
