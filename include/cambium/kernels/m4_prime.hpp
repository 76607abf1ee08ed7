// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/piecewise_polynomial.hpp>

namespace cambium {

/// M4': the cubic B-spline M4 extrapolated once, (3 M4 + x dM4/dx) / 2; equals Lambda_{2,1} (Monaghan 1985).
struct M4Prime {
  static constexpr int support = 4;
  static constexpr int moments = 2;
  static constexpr int continuity = 1;
  static constexpr bool interpolating = true;
  static constexpr PiecewisePolynomial<4, 3> pieces{{{
      {2, {2, 0, -5, 3}},
      {2, {4, -8, 5, -1}},
  }}};

  template <class T>
  static constexpr T value(T x) {
    return pieces(x);
  }
};

}  // namespace cambium
