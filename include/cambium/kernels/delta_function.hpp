// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstddef>

#include <cambium/kernels/remeshing_kernel.hpp>

namespace cambium {

/// A regularised delta function of the immersed boundary method: a remeshing kernel that also states its
///   static constexpr int continuity          phi is in C^continuity
/// and, optionally,
///   static constexpr bool even_odd           sums of phi(t - j) over even j and over odd j are both 1/2 at every t
///   static constexpr double sum_of_squares   sum_j phi(t - j)^2, the same at every t
///   static constexpr std::array<double, n> constant_moments   sum_j (j - t)^a phi(t - j), the same at every t
///
/// The even-odd condition keeps the checkerboard mode of centred differences undriven; a constant sum of squares bounds
/// how much a force depends on where the lattice lies. Peskin, Acta Numerica 11 (2002) 479, section 6.
template <class K>
concept DeltaFunction = RemeshingKernel<K> && requires {
  { K::continuity } -> std::convertible_to<int>;
};

namespace detail {

/// sum of phi(t - j)^power over the j under the kernel whose distance from `parity` is even; over all if parity < 0
template <class K>
constexpr double parity_sum(int parity, int power, double t) {
  double sum = 0.0;
  const int first = first_node<K>(t);
  for (int j = first; j < first + K::support; ++j) {
    if (parity >= 0 && (j - parity) % 2 != 0) continue;
    const double value = static_cast<double>(K::value(t - j));
    sum += power == 2 ? value * value : value;
  }
  return sum;
}

template <class K>
consteval bool has_equal_even_and_odd_sums() {
  for (int step = 0; step < 16; ++step) {
    for (int parity = 0; parity < 2; ++parity) {
      if (!(absolute(parity_sum<K>(parity, 1, step / 16.0) - 0.5) <= 1e-12)) return false;
    }
  }
  return true;
}

template <class K>
consteval bool has_declared_sum_of_squares() {
  for (int step = 0; step < 16; ++step) {
    if (!(absolute(parity_sum<K>(-1, 2, step / 16.0) - K::sum_of_squares) <= 1e-12)) return false;
  }
  return true;
}

template <class K>
consteval bool has_declared_constant_moments() {
  for (std::size_t a = 0; a < K::constant_moments.size(); ++a) {
    for (int step = 0; step < 16; ++step) {
      const double moment = discrete_moment<K>(static_cast<int>(a), step / 16.0);
      if (!(absolute(moment - K::constant_moments[a]) <= 1e-11)) return false;
    }
  }
  return true;
}

}  // namespace detail

/// Checks at compile time what a delta function declares of itself, one readable message for each statement.
template <class K>
constexpr void check_delta_function() {
  static_assert(DeltaFunction<K>,
                "cambium: a delta function needs static constexpr int support, int moments, int continuity and "
                "value(x); see docs/concepts/DeltaFunction.md");
  if constexpr (DeltaFunction<K>) {
    check_remeshing_kernel<K>();
    if constexpr (detail::ConstantKernel<K>) {
      if constexpr (requires { K::even_odd; }) {
        static_assert(K::even_odd == detail::has_equal_even_and_odd_sums<K>(),
                      "cambium: delta function does not satisfy the even-odd condition as it declares: sums over even "
                      "and over odd nodes must both be 1/2");
      }
      if constexpr (requires { K::sum_of_squares; }) {
        static_assert(detail::has_declared_sum_of_squares<K>(),
                      "cambium: the squares of the delta function's weights do not have the sum it declares");
      }
      if constexpr (requires { K::constant_moments; }) {
        static_assert(detail::has_declared_constant_moments<K>(),
                      "cambium: delta function does not have the constant moments it declares");
      }
    }
  }
}

}  // namespace cambium
