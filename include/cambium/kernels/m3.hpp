// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/piecewise_polynomial.hpp>

namespace cambium {

/// The quadratic B-spline M3 (triangular-shaped cloud): smooths, never overshoots (Schoenberg 1946).
struct M3 {
  static constexpr int support = 3;
  static constexpr int moments = 1;
  static constexpr int continuity = 1;
  static constexpr bool interpolating = false;
  static constexpr PiecewisePolynomial<3, 2> pieces{{{
      {4, {3, 0, -4}},
      {8, {9, -12, 4}},
  }}};

  template <class T>
  static constexpr T value(T x) {
    return pieces(x);
  }
};

}  // namespace cambium
