// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/piecewise_polynomial.hpp>

namespace cambium {

/// Lagrange's interpolation by the quintic through the six nearest nodes (Everett's form): one degree more than the
/// smooth kernels of its support, but only continuous.
struct Lagrange6 {
  static constexpr int support = 6;
  static constexpr int moments = 5;
  static constexpr int continuity = 0;
  static constexpr bool interpolating = true;
  static constexpr PiecewisePolynomial<6, 5> pieces{{{
      {12, {12, -4, -15, 5, 3, -1}},
      {24, {24, -26, -15, 25, -9, 1}},
      {120, {120, -274, 225, -85, 15, -1}},
  }}};

  template <class T>
  static constexpr T value(T x) {
    return pieces(x);
  }
};

}  // namespace cambium
