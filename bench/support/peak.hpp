// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>

#include <cambium/simd/pack.hpp>

namespace bench {

/// Multiply-adds of the widest vectors that touch no memory: what a core can do at most.
template <class T>
class FmaPeak {
 public:
  /// Twelve chains: more than the latency (4) times the units (2) of any core so far, and fewer than the registers.
  static constexpr std::size_t chains = 12;
  static constexpr std::size_t lanes = cambium::simd::native_lanes<T>;
  static constexpr double flops_per_step = 2.0 * chains * lanes;

  /// \return a number that depends on every step
  static T run(std::size_t steps) { return run(steps, std::make_index_sequence<chains>{}); }

 private:
  using Pack = cambium::simd::Pack<T, lanes>;

  template <std::size_t... I>
  static T run(std::size_t steps, std::index_sequence<I...>) {
    volatile T factor = T(0.999);  // unknown to the compiler
    volatile T term = T(0.001);
    const Pack a(factor);
    const Pack b(term);
    Pack chain[chains] = {Pack(static_cast<T>(I))...};
    for (std::size_t s = 0; s < steps; ++s) ((chain[I] = fma(chain[I], a, b)), ...);
    T total(0);
    ((total += sum(chain[I])), ...);
    return total;
  }
};

}  // namespace bench
