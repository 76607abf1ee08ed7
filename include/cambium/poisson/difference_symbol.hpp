// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>

namespace cambium {

/// How derivatives act on a wave exp(i k x) of a lattice of spacing h, theta = k h in [-pi, pi]: a plain struct with
///   static double second(theta)  -d^2/dx^2 multiplies the wave by second(theta) / h^2; positive but for theta = 0
///   static double first(theta)   d/dx multiplies the wave by i first(theta) / h; odd
///   static constexpr int order   the error is O(h^order); 0 if it falls faster than any power
template <class Symbol>
concept DifferenceSymbol = requires(double theta) {
  { Symbol::order } -> std::convertible_to<int>;
  { Symbol::second(theta) } -> std::convertible_to<double>;
  { Symbol::first(theta) } -> std::convertible_to<double>;
};

/// Checks at compile time that Symbol tells how derivatives act on waves.
template <class Symbol>
constexpr void check_difference_symbol() {
  static_assert(DifferenceSymbol<Symbol>,
                "cambium: a difference symbol needs static constexpr int order, second(theta) and first(theta); see "
                "docs/concepts/DifferenceSymbol.md");
}

}  // namespace cambium
