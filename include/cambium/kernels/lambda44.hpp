// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/piecewise_polynomial.hpp>

namespace cambium {

/// Lambda_{4,4}: reproduces degree 4, C^4, 6 points. Even, and on every unit cell the Hermite interpolant of the
/// centred finite-difference weights of derivatives 0, ..., 4 (Cottet, Etancelin, Perignon & Picard 2014).
struct Lambda44 {
  static constexpr int support = 6;
  static constexpr int moments = 4;
  static constexpr int continuity = 4;
  static constexpr bool interpolating = true;
  static constexpr PiecewisePolynomial<6, 9> pieces{{{
      {12, {12, 0, -15, 0, 3, -400, 1365, -1770, 1035, -230}},
      {24, {-4776, 32910, -98925, 170550, -185859, 132700, -62055, 18330, -3105, 230}},
      {24, {141912, -535410, 892755, -863370, 533613, -218564, 59325, -10290, 1035, -46}},
  }}};

  template <class T>
  static constexpr T value(T x) {
    return pieces(x);
  }
};

}  // namespace cambium
