// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstddef>

#include <cambium/kernels/piecewise_polynomial.hpp>

namespace cambium {

/// A remeshing kernel: a plain struct with
///   static constexpr int support   number of lattice nodes under the kernel along one axis
///   static constexpr int moments   largest degree p with sum_j (j - t)^a W(t - j) = delta_{a0} for a = 0, ..., p
///   static constexpr value(x)      W(x), an even function, zero for |x| >= support / 2
/// and, optionally,
///   static constexpr int continuity      W is in C^continuity
///   static constexpr bool interpolating  W(0) = 1 and W(k) = 0 at the other integers
///   static constexpr PiecewisePolynomial<support, degree> pieces   exact coefficients: the fast path
///   static constexpr int degree          degree of W between break points: the fast path without `pieces`
template <class K>
concept RemeshingKernel = requires {
  { K::support } -> std::convertible_to<int>;
  { K::moments } -> std::convertible_to<int>;
  { K::value(0.5) } -> std::convertible_to<double>;
};

/// Order of accuracy of remeshing a smooth function: moments + 1.
template <RemeshingKernel K>
inline constexpr int order_of = K::moments + 1;

namespace detail {

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
      if (absolute(discrete_moment<K>(a, step / 16.0) - expected) > 1e-9) return false;
    }
  }
  return true;
}

template <class K>
consteval bool is_even_with_declared_support() {
  for (int step = 0; step <= 16 * K::support; ++step) {
    const double x = step / 16.0;
    if (absolute(static_cast<double>(K::value(x) - K::value(-x))) > 1e-12) return false;
    if (2.0 * x >= K::support && absolute(static_cast<double>(K::value(x))) > 1e-12) return false;
  }
  return true;
}

template <class K>
consteval bool interpolates() {
  for (int k = 0; k <= K::support / 2; ++k) {
    if (absolute(static_cast<double>(K::value(static_cast<double>(k))) - (k == 0 ? 1.0 : 0.0)) > 1e-12) return false;
  }
  return true;
}

/// Derivatives 0, ..., continuity agree from both sides of every break point; odd ones vanish at 0.
template <class K>
consteval bool is_continuous() {
  constexpr auto& p = K::pieces;
  for (int order = 0; order <= K::continuity; ++order) {
    if (order % 2 == 1 && absolute(p.derivative(0, order, 0.0)) > 1e-9) return false;
    for (int i = 0; i < p.count; ++i) {
      const double at = i + (K::support % 2 == 0 ? 1.0 : 0.5);
      const double right = i + 1 < p.count ? p.derivative(i + 1, order, at) : 0.0;
      // Terms reach 1e10 / 720 for the widest kernel: round-off of 1e-6 remains.
      if (absolute(p.derivative(i, order, at) - right) > 1e-4) return false;
    }
  }
  return true;
}

}  // namespace detail

/// Checks at compile time what a kernel declares of itself, one readable message for each statement.
template <class K>
constexpr void check_remeshing_kernel() {
  static_assert(RemeshingKernel<K>,
                "cambium: a remeshing kernel needs static constexpr int support, int moments and value(x); see "
                "docs/concepts/RemeshingKernel.md");
  if constexpr (RemeshingKernel<K>) {
    static_assert(K::support >= 2 && K::support <= 16, "cambium: kernel support must be between 2 and 16 nodes");
    static_assert(detail::is_even_with_declared_support<K>(),
                  "cambium: kernel is not an even function that vanishes outside its declared support");
    static_assert(detail::moments_hold<K>(),
                  "cambium: kernel does not have the moments it declares: sum_j (j - t)^a W(t - j) must be 1 for a = 0 "
                  "and 0 for 1 <= a <= moments at every offset t");
    if constexpr (requires { K::interpolating; }) {
      static_assert(K::interpolating == detail::interpolates<K>(),
                    "cambium: kernel is declared interpolating but is not, or the other way round: interpolating means "
                    "W(0) = 1 and W(k) = 0 at every other integer k");
    }
    if constexpr (requires {
                    K::continuity;
                    K::pieces;
                  }) {
      static_assert(detail::is_continuous<K>(), "cambium: kernel is not of the continuity class it declares");
    }
  }
}

}  // namespace cambium
