// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/piecewise_polynomial.hpp>

namespace cambium {

/// M6 of the growth papers: fourth order, six points; equals Lambda_{4,2} (Bergdorf & Koumoutsakos 2006, eq. 11.21).
/// Not the quintic B-spline of the same name.
struct M6 {
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
