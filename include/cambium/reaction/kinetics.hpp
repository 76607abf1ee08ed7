// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <type_traits>

#include <cambium/core/vec.hpp>

namespace cambium {

/// What reacts at a point, dc/dt = F(c): a plain function object of the concentrations
///   static constexpr int species                                how many there are
///   kinetics(const Vec<species>& c) const -> Vec<species>       the rates F(c)
/// and, where it has them,
///   kinetics.jacobian(c) -> Vec<species, Vec<species>>          row s: derivatives of F_s (else found by differences)
///   kinetics.fixed_points() -> a range of Vec<species>          all uniform states, F(c) = 0
template <class K>
concept Kinetics = std::copy_constructible<K> && requires(const K& kinetics) {
  { K::species } -> std::convertible_to<int>;
  { kinetics(Vec<K::species>{}) } -> std::convertible_to<Vec<K::species>>;
};

/// Checks K at compile time, one readable message for each requirement.
template <class K>
constexpr void check_kinetics() {
  static_assert(
      requires { K::species; },
      "cambium: kinetics say how many species react: static constexpr int species; see docs/concepts/Kinetics.md");
  if constexpr (requires { K::species; }) {
    static_assert(Kinetics<K>,
                  "cambium: kinetics are called as kinetics(c) const with a Vec<species> of concentrations and return "
                  "their rates, a Vec<species>; see docs/concepts/Kinetics.md");
  }
}

/// Derivatives of rates: row s holds those of F_s.
template <int N>
using Jacobian = Vec<N, Vec<N>>;

}  // namespace cambium
