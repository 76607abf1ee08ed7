// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <type_traits>

#include <cambium/core/columns.hpp>
#include <cambium/parallel/execution.hpp>
#include <cambium/reaction/kinetics.hpp>

namespace cambium {

/// rate[k] := factor_s rate_s[k] + F_s(c[k]) for every entry and species: reaction on top of what is there, with
/// factor = the diffusivities on top of Laplacians; factor = 0 overwrites, whatever is there.
/// \param kinetics  called with Vec<species, T>, or, if it takes doubles only, with those
/// \throws SizeError unless both have the same size
template <Kinetics K, class C, class T, Execution E = OpenMP>
void react(const K& kinetics, const Columns<K::species, C>& c, const Vec<K::species>& factor,
           const Columns<K::species, T>& rate, const E& execution = {}) {
  constexpr int N = K::species;
  require_size(rate.size(), c.size(), "the array of rates");
  constexpr bool takes_own = requires(const Vec<N, T>& x) {
    { kinetics(x) } -> std::convertible_to<Vec<N, T>>;
  };
  using Number = std::conditional_t<takes_own, T, double>;
  Vec<N, T> weight;
  for (int s = 0; s < N; ++s) weight[s] = static_cast<T>(factor[s]);
  const bool fresh = factor == Vec<N>{};
  for_each_piece(execution, c.size(), 2048, [&](std::size_t begin, std::size_t end) {
    const K local = kinetics;
#if defined(_OPENMP)
#pragma omp simd
#endif
    for (std::size_t k = begin; k < end; ++k) {
      Vec<N, Number> x;
      for (int s = 0; s < N; ++s) x[s] = static_cast<Number>(c.column(s)[k]);
      const Vec<N, Number> f = local(x);
      for (int s = 0; s < N; ++s) {
        T* const to = rate.column(s).data() + k;
        *to = static_cast<T>(f[s]) + (fresh ? T(0) : weight[s] * *to);
      }
    }
  });
}

}  // namespace cambium
