// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/piecewise_polynomial.hpp>

namespace cambium {

/// Lambda_{2,2}: reproduces degree 2, C^2, 4 points. Even, and on every unit cell the Hermite interpolant of the
/// centred finite-difference weights of derivatives 0, ..., 2 (Cottet, Etancelin, Perignon & Picard 2014).
struct Lambda22 {
  static constexpr int support = 4;
  static constexpr int moments = 2;
  static constexpr int continuity = 2;
  static constexpr bool interpolating = true;
  static constexpr PiecewisePolynomial<4, 5> pieces{{{
      {2, {2, 0, -2, -9, 15, -6}},
      {2, {-8, 36, -58, 43, -15, 2}},
  }}};

  template <class T>
  static constexpr T value(T x) {
    return pieces(x);
  }
};

}  // namespace cambium
