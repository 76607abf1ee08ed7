// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/remeshing_kernel.hpp>

namespace cambium {
namespace detail {

/// Degree of the polynomials between the break points of a kernel, or -1 if the kernel does not tell.
template <class K>
consteval int tap_degree() {
  if constexpr (requires { K::pieces; }) {
    return K::pieces.degree;
  } else if constexpr (requires { K::degree; }) {
    return K::degree;
  } else {
    return -1;
  }
}

template <class K>
struct TapTable {
  double value[tap_degree<K>() < 0 ? 1 : tap_degree<K>() + 1][K::support]{};
};

__extension__ using WideInteger = __int128;

/// Exact binomial expansion of piece(|g + b|), b = (support - 1)/2 - k = twice_b / 2, in integers.
template <class K>
constexpr void expand_piece(int k, TapTable<K>& table) {
  constexpr int support = K::support;
  constexpr int degree = tap_degree<K>();
  const int twice_b = support - 1 - 2 * k;
  const int sign = twice_b < 0 ? -1 : 1;
  const auto& piece = K::pieces.piece[(sign * twice_b + (support % 2 == 0 ? 0 : 1)) / 2];
  for (int m = 0; m <= degree; ++m) {
    WideInteger sum = 0;  // sum_j c_j sign^j C(j, m) twice_b^(j - m) 2^(degree - j + m)
    for (int j = m; j <= degree; ++j) {
      WideInteger term = piece.numerator[j] * (j % 2 == 1 ? sign : 1);
      for (int i = 0; i < m; ++i) term = term * (j - i) / (i + 1);
      for (int i = 0; i < j - m; ++i) term *= twice_b;
      for (int i = 0; i < degree - j; ++i) term *= 2;
      sum += term;
    }
    double scale = static_cast<double>(piece.denominator);
    for (int i = 0; i < degree - m; ++i) scale *= 2.0;
    table.value[m][k] = static_cast<double>(sum) / scale;
  }
}

/// Newton interpolation of value() at degree + 1 equidistant points inside the piece, turned into powers of g.
template <class K>
constexpr void fit_piece(int k, TapTable<K>& table) {
  constexpr int support = K::support;
  constexpr int n = tap_degree<K>() + 1;
  double point[n]{};
  double divided[n]{};
  for (int i = 0; i < n; ++i) {
    point[i] = (i + 0.5) / n - 0.5;
    divided[i] = static_cast<double>(K::value(point[i] + 0.5 * (support - 1) - k));
  }
  for (int order = 1; order < n; ++order) {
    for (int i = n - 1; i >= order; --i) divided[i] = (divided[i] - divided[i - 1]) / (point[i] - point[i - order]);
  }
  double power[n]{};
  for (int i = n - 1; i >= 0; --i) {
    for (int j = n - 1; j >= 0; --j) power[j] = (j > 0 ? power[j - 1] : 0.0) - point[i] * power[j];
    power[0] += divided[i];
  }
  for (int j = 0; j < n; ++j) table.value[j][k] = power[j];
}

template <class K>
consteval TapTable<K> tabulate_taps() {
  TapTable<K> table{};
  for (int k = 0; k < K::support; ++k) {
    if constexpr (requires { K::pieces; }) {
      expand_piece<K>(k, table);
    } else if constexpr (requires { K::degree; }) {
      fit_piece<K>(k, table);
    }
  }
  return table;
}

}  // namespace detail

/// Weights of the `support` nodes under a remeshing kernel as polynomials of the offset from the middle of the stencil.
///
/// With u the position in spacings, shift = 0 (even support) or 1/2 (odd), cell = floor(u + shift) and
/// g = u + shift - cell - 1/2 in [-1/2, 1/2), tap k is node first(cell) + k and has weight W(g + reach - k) with
/// reach = (support - 1) / 2. Between break points W is a polynomial, so each tap is one polynomial of g, and Horner's
/// rule runs across the taps without a branch.
template <RemeshingKernel K>
struct Taps {
  static constexpr int support = K::support;
  /// Added to u before the floor.
  static constexpr double shift = support % 2 == 0 ? 0.0 : 0.5;
  /// First node of the stencil is cell - before.
  static constexpr int before = (support - 1) / 2;
  /// True if the weights are polynomials known at compile time.
  static constexpr bool polynomial = detail::tap_degree<K>() >= 0;
  static constexpr int degree = detail::tap_degree<K>();

  /// coefficients.value[j][k]: coefficient of g^j in the weight of tap k.
  static constexpr detail::TapTable<K> coefficients = detail::tabulate_taps<K>();

  /// Weights w[0], ..., w[support - 1] at g.
  template <class T>
  static constexpr void weights(T g, T* w) {
    for (int k = 0; k < support; ++k) {
      if constexpr (polynomial) {
        T sum = static_cast<T>(coefficients.value[degree][k]);
        for (int j = degree - 1; j >= 0; --j) sum = sum * g + static_cast<T>(coefficients.value[j][k]);
        w[k] = sum;
      } else {
        w[k] = static_cast<T>(K::value(static_cast<double>(g) + 0.5 * (support - 1) - k));
      }
    }
  }
};

}  // namespace cambium
