// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/piecewise_polynomial.hpp>

namespace cambium {

/// Lambda_{4,2}: reproduces degree 4, C^2, 6 points. Even, and on every unit cell the Hermite interpolant of the
/// centred finite-difference weights of derivatives 0, ..., 2 (Cottet, Etancelin, Perignon & Picard 2014).
/// The same function as M6.
struct Lambda42 {
  static constexpr int support = 6;
  static constexpr int moments = 4;
  static constexpr int continuity = 2;
  static constexpr bool interpolating = true;
  static constexpr PiecewisePolynomial<6, 5> pieces{{{
      {12, {12, 0, -15, -35, 63, -25}},
      {24, {-96, 450, -735, 545, -189, 25}},
      {24, {432, -918, 765, -313, 63, -5}},
  }}};

  template <class T>
  static constexpr T value(T x) {
    return pieces(x);
  }
};

}  // namespace cambium
