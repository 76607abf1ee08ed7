// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/piecewise_polynomial.hpp>

namespace cambium {

/// The cubic B-spline M4: smooths, never overshoots (Schoenberg 1946).
struct M4 {
  static constexpr int support = 4;
  static constexpr int moments = 1;
  static constexpr int continuity = 2;
  static constexpr bool interpolating = false;
  static constexpr PiecewisePolynomial<4, 3> pieces{{{
      {6, {4, 0, -6, 3}},
      {6, {8, -12, 6, -1}},
  }}};

  template <class T>
  static constexpr T value(T x) {
    return pieces(x);
  }
};

}  // namespace cambium
