// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/remeshing_kernel.hpp>

/// Four-point Lagrange interpolation, the cubic through the four nodes around x: RemeshingKernel.
struct Cubic {
  static constexpr int support = 4;
  static constexpr int moments = 3;
  static constexpr int degree = 3;
  static constexpr bool interpolating = true;

  template <class T>
  static constexpr T value(T x) {
    if (x < T(0)) x = -x;
    if (x < T(1)) return (T(1) - x) * (T(1) + x) * (T(2) - x) / T(2);
    return x < T(2) ? (T(1) - x) * (T(2) - x) * (T(3) - x) / T(6) : T(0);
  }
};
