// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/kernel_checks.hpp>

namespace cambium::detail {

/// `order`-th derivative of piece i at twice_x / 2, times the denominator and 2^(degree - order): an integer.
template <class Pieces>
constexpr WideInteger scaled_derivative(const Pieces& p, int i, int order, int twice_x) {
  WideInteger sum = 0;
  for (int j = order; j <= Pieces::degree; ++j) {
    WideInteger term = p.piece[i].numerator[j];
    for (int m = 0; m < order; ++m) term *= j - m;
    for (int m = 0; m < j - order; ++m) term *= twice_x;
    for (int m = 0; m < Pieces::degree - j; ++m) term *= 2;
    sum += term;
  }
  return sum;
}

/// Derivatives 0, ..., continuity agree from both sides of every break point, and odd ones vanish at 0. In exact
/// integers.
template <class K>
consteval bool pieces_are_continuous() {
  constexpr auto& p = K::pieces;
  for (int order = 0; order <= K::continuity; ++order) {
    if (order % 2 == 1 && scaled_derivative(p, 0, order, 0) != 0) return false;
    for (int i = 0; i < p.count; ++i) {
      const int twice_x = 2 * i + (K::support % 2 == 0 ? 2 : 1);
      const WideInteger left = scaled_derivative(p, i, order, twice_x);
      const bool last = i + 1 == p.count;
      const WideInteger right = last ? 0 : scaled_derivative(p, last ? i : i + 1, order, twice_x);
      if (left * p.piece[last ? i : i + 1].denominator != right * p.piece[i].denominator) return false;
    }
  }
  return true;
}

/// Highest continuity class that can be told from values of a kernel without `pieces`.
inline constexpr int largest_sampled_continuity = 4;

struct OneSidedDerivatives {
  double value[largest_sampled_continuity + 1]{};
};

/// One-sided derivatives of W at x from the polynomial through 8 values at x, x + step, x + 2 step, ...: Newton's
/// forward differences, turned into powers.
template <class K>
constexpr OneSidedDerivatives one_sided_derivatives(double x, double step) {
  constexpr int n = 8;
  double newton[n]{};  // differences of order i over i!
  for (int i = 0; i < n; ++i) newton[i] = static_cast<double>(K::value(x + i * step));
  for (int order = 1; order < n; ++order) {
    for (int i = n - 1; i >= order; --i) newton[i] = (newton[i] - newton[i - 1]) / order;
  }
  double power[n]{};
  for (int i = n - 1; i >= 0; --i) {
    for (int j = n - 1; j >= 0; --j) power[j] = (j > 0 ? power[j - 1] : 0.0) - i * power[j];
    power[0] += newton[i];
  }
  OneSidedDerivatives result;
  double scale = 1.0;
  for (int order = 0; order <= largest_sampled_continuity; ++order) {
    result.value[order] = power[order] * scale;
    scale *= (order + 1) / step;
  }
  return result;
}

/// Jumps of derivatives 0, ..., continuity at the multiples of 1/2 are below 2e-3 of 1 + the derivative. With a step of
/// 1/128 round-off leaves 1e-4 in the fourth derivative, truncation less; jumps of true kernels are 1e-2 and more.
template <class K>
consteval bool value_is_continuous() {
  for (int half = 0; half <= K::support; ++half) {
    const auto left = one_sided_derivatives<K>(0.5 * half, -1.0 / 128.0);
    const auto right = one_sided_derivatives<K>(0.5 * half, 1.0 / 128.0);
    for (int order = 0; order <= K::continuity; ++order) {
      const double scale = 1.0 + absolute(left.value[order]);
      if (!(absolute(left.value[order] - right.value[order]) <= 2e-3 * scale)) return false;
    }
  }
  return true;
}

template <class K>
consteval bool is_continuous() {
  if constexpr (requires { K::pieces; }) {
    return pieces_are_continuous<K>();
  } else {
    return value_is_continuous<K>();
  }
}

}  // namespace cambium::detail
