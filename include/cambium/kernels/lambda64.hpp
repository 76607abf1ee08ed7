// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/piecewise_polynomial.hpp>

namespace cambium {

/// Lambda_{6,4}: reproduces degree 6, C^4, 8 points. Even, and on every unit cell the Hermite interpolant of the
/// centred finite-difference weights of derivatives 0, ..., 4 (Cottet, Etancelin, Perignon & Picard 2014).
struct Lambda64 {
  static constexpr int support = 8;
  static constexpr int moments = 6;
  static constexpr int continuity = 4;
  static constexpr bool interpolating = true;
  static constexpr PiecewisePolynomial<8, 9> pieces{{{
      {144, {144, 0, -196, 0, 56, -3521, 12029, -15617, 9135, -2030}},
      {240, {-42096, 290332, -872802, 1504720, -1639890, 1170981, -547647, 161777, -27405, 2030}},
      {720, {6260400, -23620716, 39388090, -38094000, 23545690, -9644621, 2617945, -454097, 45675, -2030}},
      {720, {-20524032, 54049536, -63077504, 42814560, -18626300, 5385983, -1035149, 127511, -9135, 290}},
  }}};

  template <class T>
  static constexpr T value(T x) {
    return pieces(x);
  }
};

}  // namespace cambium
