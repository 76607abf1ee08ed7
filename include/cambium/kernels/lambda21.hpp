// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/piecewise_polynomial.hpp>

namespace cambium {

/// Lambda_{2,1}: reproduces degree 2, C^1, 4 points. Even, and on every unit cell the Hermite interpolant of the
/// centred finite-difference weights of derivatives 0, ..., 1 (Cottet, Etancelin, Perignon & Picard 2014).
/// The same function as M4'.
struct Lambda21 {
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
