// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/piecewise_polynomial.hpp>

namespace cambium {

/// Lambda_{8,4}: reproduces degree 8, C^4, 10 points. Even, and on every unit cell the Hermite interpolant of the
/// centred finite-difference weights of derivatives 0, ..., 4 (Cottet, Etancelin, Perignon & Picard 2014).
struct Lambda84 {
  static constexpr int support = 10;
  static constexpr int moments = 8;
  static constexpr int continuity = 4;
  static constexpr bool interpolating = true;
  static constexpr PiecewisePolynomial<10, 9> pieces{{{
      {2880, {2880, 0, -4100, 0, 1365, -55629, 190110, -247050, 144545, -32121}},
      {1440, {-221760, 1530840, -4602460, 7934430, -8647485, 6175323, -2888310, 853260, -144545, 10707}},
      {10080, {99037440, -373683960, 623150300, -602701470, 372540945, -152602569, 41423550, -7185240, 722725, -32121}},
      {40320,
       {-2273040000, 5986145520, -6986182420, 4742046540, -2063042835, 596557269, -114655170, 14123430, -1011815,
        32121}},
      {40320,
       {2530800000, -5135050000, 4622507500, -2422976500, 814989525, -182421981, 27172110, -2597150, 144545, -3569}},
  }}};

  template <class T>
  static constexpr T value(T x) {
    return pieces(x);
  }
};

}  // namespace cambium
