// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <concepts>

namespace cambium {

namespace detail {

__extension__ using WideInteger = __int128;

}  // namespace detail

/// An even, piecewise polynomial function of compact support, stored as exact integer fractions.
///
/// Support is the number of lattice nodes under the kernel along one axis. For even Support the break points are
/// 1, 2, ..., Support/2; for odd Support they are 1/2, 3/2, ..., Support/2. Piece i holds between break points i and
/// i + 1 and is sum_j numerator[j] |x|^j / denominator.
///
/// Powers of |x| cancel badly away from zero (Lambda_{8,4} would lose seven digits), so floating-point values come from
/// the same polynomials expanded about the middle of each piece; the expansion is exact and done at compile time.
template <int Support, int Degree>
class PiecewisePolynomial {
 public:
  static constexpr int count = (Support + 1) / 2;
  static constexpr int degree = Degree;

  struct Piece {
    long long denominator;
    std::array<long long, Degree + 1> numerator;
  };

  constexpr PiecewisePolynomial(const std::array<Piece, count>& pieces) : piece(pieces) {
    for (int i = 0; i < count; ++i) {
      for (int m = 0; m <= Degree; ++m) centred_[i][m] = expand(i, m);
    }
  }

  std::array<Piece, count> piece;

  /// Value at x: to 3e-16 of the largest value in floating point, exactly for an exact rational type.
  template <class T>
  constexpr T operator()(T x) const {
    if (x < T(0)) x = -x;
    for (int i = 0; i < count; ++i) {
      if (T(2) * x > T(2 * i + (Support % 2 == 0 ? 2 : 1))) continue;
      if constexpr (std::floating_point<T>) {
        return about_middle(i, x);
      } else {
        return by_powers(i, x);
      }
    }
    return T(0);
  }

  /// Middle of piece i. The innermost piece of an odd support reaches from -1/2 to 1/2: its middle is 0.
  static constexpr double middle(int i) { return Support % 2 == 0 ? i + 0.5 : i; }
  /// Coefficient of (|x| - middle(i))^m in piece i, correctly rounded but for the last bit.
  constexpr double centred(int i, int m) const { return centred_[i][m]; }

  /// `order`-th derivative of piece i at x >= 0 (x need not lie in the piece: one-sided limits at break points). Meant
  /// for exact types; in floating point it cancels away from zero.
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

 private:
  template <class T>
  constexpr T about_middle(int i, T x) const {
    const T g = x - T(middle(i));
    T sum(0);
    for (int m = Degree; m >= 0; --m) sum = sum * g + T(centred_[i][m]);
    return sum;
  }
  template <class T>
  constexpr T by_powers(int i, const T& x) const {
    T sum(0);
    for (int j = Degree; j >= 0; --j) sum = sum * x + T(piece[i].numerator[j]);
    return sum / T(piece[i].denominator);
  }

  /// With |x| = g + b/2: coefficient of g^m, sum_j c_j C(j, m) (b/2)^(j - m), summed exactly in integers.
  constexpr double expand(int i, int m) const {
    const int b = 2 * i + (Support % 2 == 0 ? 1 : 0);
    detail::WideInteger sum = 0;
    for (int j = m; j <= Degree; ++j) {
      detail::WideInteger term = piece[i].numerator[j];
      for (int k = 0; k < m; ++k) term = term * (j - k) / (k + 1);
      for (int k = 0; k < j - m; ++k) term *= b;
      for (int k = 0; k < Degree - j; ++k) term *= 2;
      sum += term;
    }
    double scale = static_cast<double>(piece[i].denominator);
    for (int k = 0; k < Degree - m; ++k) scale *= 2.0;
    return static_cast<double>(sum) / scale;
  }

  std::array<std::array<double, Degree + 1>, count> centred_{};
};

}  // namespace cambium
