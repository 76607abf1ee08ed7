// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/piecewise_polynomial.hpp>

namespace cambium {

/// M6''': the quintic B-spline B (support 6) extrapolated three times, 20/11 B + x B' + 7/88 x^2 B'' - 1/264 x^3 B'''.
/// Its continuous moments vanish up to degree 5, its discrete moments, which remeshing sees, only up to degree 2.
struct M6TriplePrime {
  static constexpr int support = 6;
  static constexpr int moments = 2;
  static constexpr int continuity = 1;
  static constexpr bool interpolating = true;
  static constexpr PiecewisePolynomial<6, 5> pieces{{{
      {88, {88, 0, -175, 0, 147, -60}},
      {176, {136, 310, -1225, 1160, -441, 60}},
      {176, {648, -1674, 1575, -696, 147, -12}},
  }}};

  template <class T>
  static constexpr T value(T x) {
    return pieces(x);
  }
};

}  // namespace cambium
