// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/piecewise_polynomial.hpp>

namespace cambium {

/// Lagrange's interpolation by the cubic through the four nearest nodes (Everett's form): one degree more than the
/// smooth kernels of its support, but only continuous.
struct Lagrange4 {
  static constexpr int support = 4;
  static constexpr int moments = 3;
  static constexpr int continuity = 0;
  static constexpr bool interpolating = true;
  static constexpr PiecewisePolynomial<4, 3> pieces{{{
      {2, {2, -1, -2, 1}},
      {6, {6, -11, 6, -1}},
  }}};

  template <class T>
  static constexpr T value(T x) {
    return pieces(x);
  }
};

}  // namespace cambium
