// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/piecewise_polynomial.hpp>

namespace cambium {

/// The hat function (B-spline M2): linear interpolation, cloud in cell, and Peskin's two-point delta function.
struct Hat {
  static constexpr int support = 2;
  static constexpr int moments = 1;
  static constexpr int continuity = 0;
  static constexpr bool interpolating = true;
  static constexpr PiecewisePolynomial<2, 1> pieces{{{
      {1, {1, -1}},
  }}};

  template <class T>
  static constexpr T value(T x) {
    return pieces(x);
  }
};

}  // namespace cambium
