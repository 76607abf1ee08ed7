// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/piecewise_polynomial.hpp>

namespace cambium::detail {

constexpr double absolute(double x) { return x < 0.0 ? -x : x; }

/// First node under the kernel at offset t in [0, 1) from a node, relative to that node.
template <class K>
constexpr int first_node(double t) {
  if constexpr (K::support % 2 == 0) {
    return 1 - K::support / 2;
  } else {
    return (t < 0.5 ? 0 : 1) - K::support / 2;
  }
}

/// sum_j (j - t)^power W(t - j)
template <class K>
constexpr double discrete_moment(int power, double t) {
  double sum = 0.0;
  const int first = first_node<K>(t);
  for (int j = first; j < first + K::support; ++j) {
    double term = static_cast<double>(K::value(t - j));
    for (int a = 0; a < power; ++a) term *= j - t;
    sum += term;
  }
  return sum;
}

/// Sweep over 16 offsets. Tolerance: (j - t)^p <= 5^8 = 4e5 times 1e-16 times support leaves 1e-9.
template <class K>
consteval bool moments_hold() {
  for (int step = 0; step < 16; ++step) {
    for (int a = 0; a <= K::moments; ++a) {
      const double expected = a == 0 ? 1.0 : 0.0;
      if (!(absolute(discrete_moment<K>(a, step / 16.0) - expected) <= 1e-9)) return false;
    }
  }
  return true;
}

template <class K>
consteval bool is_even_with_declared_support() {
  for (int step = 0; step <= 16 * K::support; ++step) {
    const double x = step / 16.0;
    const double value = static_cast<double>(K::value(x));
    if (!(absolute(value - static_cast<double>(K::value(-x))) <= 1e-12)) return false;
    if (2.0 * x >= K::support && absolute(value) > 1e-12) return false;
  }
  return true;
}

template <class K>
consteval bool interpolates() {
  for (int k = 0; k <= K::support / 2; ++k) {
    const double expected = k == 0 ? 1.0 : 0.0;
    if (!(absolute(static_cast<double>(K::value(static_cast<double>(k))) - expected) <= 1e-12)) return false;
  }
  return true;
}

/// Sweep over 32 points of a spacing; round-off of a value may be below zero where the kernel touches it.
template <class K>
consteval bool has_no_negative_value() {
  for (int step = 0; step <= 16 * K::support; ++step) {
    if (!(static_cast<double>(K::value(step / 32.0)) >= -1e-15)) return false;
  }
  return true;
}

/// value() and `pieces`, which the fast path takes its coefficients from, are one function.
template <class K>
consteval bool pieces_are_the_value() {
  for (int step = 0; step <= 8 * K::support; ++step) {
    const double x = step / 16.0;
    if (!(absolute(static_cast<double>(K::value(x)) - K::pieces(x)) <= 1e-12)) return false;
  }
  return true;
}

/// Differences of order degree + 1 of value() vanish inside every piece: |difference| <= 2^(degree + 1) round-off.
template <class K>
consteval bool is_polynomial_of_declared_degree() {
  constexpr int n = K::degree + 2;
  for (int half = 0; half < K::support; ++half) {
    double difference[n]{};
    for (int i = 0; i < n; ++i) difference[i] = static_cast<double>(K::value(0.5 * half + 0.5 * (i + 0.5) / n));
    for (int order = 1; order < n; ++order) {
      for (int i = 0; i < n - order; ++i) difference[i] = difference[i + 1] - difference[i];
    }
    if (!(absolute(difference[0]) <= 1e-15 * (1 << n))) return false;
  }
  return true;
}

}  // namespace cambium::detail
