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

/// Tap k is the piece under g + b, b = (support - 1)/2 - k, whose middle is |b|: the piece's centred coefficients, with
/// the sign of odd powers turned left of zero.
template <class K>
constexpr void copy_piece(int k, TapTable<K>& table) {
  constexpr int support = K::support;
  const int twice_b = support - 1 - 2 * k;
  const int i = (twice_b < 0 ? -twice_b : twice_b) / 2;
  for (int m = 0; m <= tap_degree<K>(); ++m) {
    table.value[m][k] = K::pieces.centred(i, m) * (twice_b < 0 && m % 2 == 1 ? -1 : 1);
  }
}

/// value() in the widest type it takes, so that the fit below loses nothing if it is a template.
template <class K>
constexpr long double widest_value(double x) {
  if constexpr (requires { K::template value<long double>(0.5L); }) {
    return K::template value<long double>(x);
  } else {
    return static_cast<long double>(K::value(x));
  }
}

/// Newton interpolation of value() at degree + 1 points inside the piece, turned into powers of g. The points crowd
/// towards both ends much as Chebyshev's do (s (3 - s^2) / 2 stands for sin(pi s / 2)).
template <class K>
constexpr void fit_piece(int k, TapTable<K>& table) {
  constexpr int support = K::support;
  constexpr int n = tap_degree<K>() + 1;
  double point[n]{};
  long double divided[n]{};
  for (int i = 0; i < n; ++i) {
    const double s = (2 * i + 1.0) / n - 1.0;
    const double b = 0.5 * (support - 1) - k;
    point[i] = (b + 0.25 * s * (3.0 - s * s)) - b;  // so that point + b is exact
    divided[i] = widest_value<K>(point[i] + b);
  }
  for (int order = 1; order < n; ++order) {
    for (int i = n - 1; i >= order; --i) {
      divided[i] = (divided[i] - divided[i - 1]) / (static_cast<long double>(point[i]) - point[i - order]);
    }
  }
  long double power[n]{};
  for (int i = n - 1; i >= 0; --i) {
    for (int j = n - 1; j >= 0; --j) power[j] = (j > 0 ? power[j - 1] : 0.0L) - point[i] * power[j];
    power[0] += divided[i];
  }
  for (int j = 0; j < n; ++j) table.value[j][k] = static_cast<double>(power[j]);
}

template <class K>
consteval TapTable<K> tabulate_taps() {
  TapTable<K> table{};
  for (int k = 0; k < K::support; ++k) {
    if constexpr (requires { K::pieces; }) {
      copy_piece<K>(k, table);
    } else if constexpr (requires { K::degree; }) {
      fit_piece<K>(k, table);
    }
  }
  return table;
}

/// True if tap support - 1 - k at -g is tap k at g, to the last bit.
template <class K>
consteval bool taps_symmetric(const TapTable<K>& table) {
  for (int j = 0; j <= tap_degree<K>(); ++j) {
    for (int k = 0; k < K::support; ++k) {
      if (table.value[j][k] != (j % 2 == 0 ? 1 : -1) * table.value[j][K::support - 1 - k]) return false;
    }
  }
  return tap_degree<K>() > 0;
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
  /// True if the polynomials of the taps are mirror images of each other, as for every even kernel given by its pieces.
  static constexpr bool symmetric = detail::taps_symmetric<K>(coefficients);

  /// Weights w[0], ..., w[support - 1] at g.
  template <class T>
  static constexpr void weights(T g, T* w) {
    for (int k = 0; k < support; ++k) {
      if constexpr (polynomial) {
        T sum = static_cast<T>(coefficients.value[degree][k]);
        for (int j = degree - 1; j >= 0; --j) sum = sum * g + static_cast<T>(coefficients.value[j][k]);
        w[k] = sum;
      } else {
        w[k] = static_cast<T>(K::value(static_cast<double>(g) + (0.5 * (support - 1) - k)));
      }
    }
  }
};

}  // namespace cambium
