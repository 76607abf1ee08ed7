// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

namespace cambium {

/// An even, piecewise polynomial function of compact support, stored as exact integer fractions.
///
/// Support is the number of lattice nodes under the kernel along one axis. For even Support the break points are
/// 1, 2, ..., Support/2; for odd Support they are 1/2, 3/2, ..., Support/2. Piece i holds between break points i and
/// i + 1 and is sum_j numerator[j] |x|^j / denominator.
template <int Support, int Degree>
struct PiecewisePolynomial {
  static constexpr int count = (Support + 1) / 2;
  static constexpr int degree = Degree;

  struct Piece {
    long long denominator;
    std::array<long long, Degree + 1> numerator;
  };
  std::array<Piece, count> piece;

  /// Value at x, for any arithmetic type: float, double, or an exact rational.
  template <class T>
  constexpr T operator()(T x) const {
    if (x < T(0)) x = -x;
    for (int i = 0; i < count; ++i) {
      if (T(2) * x > T(2 * i + (Support % 2 == 0 ? 2 : 1))) continue;
      T sum(0);
      for (int j = Degree; j >= 0; --j) sum = sum * x + T(piece[i].numerator[j]);
      return sum / T(piece[i].denominator);
    }
    return T(0);
  }

  /// `order`-th derivative of piece i at x >= 0 (x need not lie in the piece: one-sided limits at break points).
  template <class T>
  constexpr T derivative(int i, int order, T x) const {
    T sum(0);
    for (int j = Degree; j >= order; --j) {
      long long falling = 1;
      for (int m = 0; m < order; ++m) falling *= j - m;
      sum = sum * x + T(falling) * T(piece[i].numerator[j]);
    }
    return sum / T(piece[i].denominator);
  }
};

}  // namespace cambium
