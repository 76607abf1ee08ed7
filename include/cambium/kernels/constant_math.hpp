// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <type_traits>

namespace cambium {

/// Square root that is also a constant expression, for kernels that are checked at compile time. At run time std::sqrt;
/// at compile time Newton's iteration from above, which falls until round-off stops it.
template <std::floating_point T>
constexpr T square_root(T x) {
  if (!std::is_constant_evaluated()) return std::sqrt(x);
  if (x < T(0)) return std::numeric_limits<T>::quiet_NaN();
  if (x == T(0)) return x;
  T root = x < T(1) ? T(1) : x;
  for (T next = (root + x / root) / T(2); next < root; next = (root + x / root) / T(2)) root = next;
  return root;
}

/// Exponential that is also a constant expression. At run time std::exp; at compile time the Taylor series after
/// halving (doubling) the argument's distance to zero by ln 2 as often as it goes.
template <std::floating_point T>
constexpr T exponential(T x) {
  if (!std::is_constant_evaluated()) return std::exp(x);
  const int halvings = static_cast<int>(x < T(-800) ? T(-1200) : x > T(800) ? T(1200) : x / std::numbers::ln2_v<T>);
  if (halvings < -1100) return T(0);
  if (halvings > 1100) return std::numeric_limits<T>::infinity();
  const T rest = x - T(halvings) * std::numbers::ln2_v<T>;
  T sum(1);
  for (int k = 24; k > 0; --k) sum = T(1) + sum * rest / T(k);
  for (int k = 0; k < halvings; ++k) sum *= T(2);
  for (int k = 0; k > halvings; --k) sum /= T(2);
  return sum;
}

/// Cosine that is also a constant expression, for |x| up to a few periods. At run time std::cos; at compile time the
/// Taylor series on [-pi, pi].
template <std::floating_point T>
constexpr T cosine(T x) {
  if (!std::is_constant_evaluated()) return std::cos(x);
  constexpr T pi = std::numbers::pi_v<T>;
  while (x > pi) x -= T(2) * pi;
  while (x < -pi) x += T(2) * pi;
  T sum(1);
  for (int k = 30; k > 0; k -= 2) sum = T(1) - sum * x * x / T(k * (k - 1));
  return sum;
}

}  // namespace cambium
