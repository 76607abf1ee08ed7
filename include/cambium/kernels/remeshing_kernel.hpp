// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <type_traits>

#include <cambium/kernels/continuity_check.hpp>
#include <cambium/kernels/kernel_checks.hpp>

namespace cambium {

/// A remeshing kernel: a plain struct with
///   static constexpr int support   number of lattice nodes under the kernel along one axis
///   static constexpr int moments   a degree p with sum_j (j - t)^a W(t - j) = delta_{a0} for a = 0, ..., p
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

/// True if W(0) = 1 and W(k) = 0 at the other integers: remeshing particles that sit on the nodes changes nothing.
template <RemeshingKernel K>
inline constexpr bool is_interpolating = detail::interpolates<K>();

/// True if remeshing particles that sit on the nodes smooths their values.
template <RemeshingKernel K>
inline constexpr bool is_smoothing = !is_interpolating<K>;

/// True if W >= 0 (at 32 points of a spacing): remeshing then never goes beyond the smallest and largest value.
template <RemeshingKernel K>
inline constexpr bool is_non_negative = detail::has_no_negative_value<K>();

namespace detail {

template <class K>
concept ConstantKernel = requires {
  typename std::bool_constant<(K::value(0.5) == K::value(0.5))>;
};

template <class K>
constexpr void check_optional_statements() {
  if constexpr (requires { K::interpolating; }) {
    static_assert(K::interpolating == interpolates<K>(),
                  "cambium: kernel is declared interpolating but is not, or the other way round: interpolating means "
                  "W(0) = 1 and W(k) = 0 at every other integer k");
  }
  if constexpr (requires { K::pieces; }) {
    static_assert(pieces_are_the_value<K>(), "cambium: kernel has `pieces` that are not the function value(x)");
  } else if constexpr (requires { K::degree; }) {
    static_assert(K::degree >= 0 && K::degree <= 20, "cambium: kernel degree must be between 0 and 20");
    static_assert(
        is_polynomial_of_declared_degree<K>(),
        "cambium: kernel is not a polynomial of the degree it declares between its break points (integers for "
        "even support, half-integers for odd)");
  }
  if constexpr (requires { K::continuity; }) {
    if constexpr (!requires { K::pieces; }) {
      static_assert(K::continuity <= largest_sampled_continuity,
                    "cambium: continuity above 4 can only be checked of a kernel that gives its `pieces`");
    }
    static_assert(is_continuous<K>(), "cambium: kernel is not of the continuity class it declares");
  }
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
    static_assert(K::moments >= 0, "cambium: kernel must at least keep the total: moments >= 0");
    static_assert(detail::ConstantKernel<K>,
                  "cambium: kernel value(x) must be a constant expression; cambium/kernels/constant_math.hpp has "
                  "square_root, exponential and cosine that are");
    if constexpr (detail::ConstantKernel<K>) {
      constexpr bool fits = detail::is_even_with_declared_support<K>();
      static_assert(fits, "cambium: kernel is not an even function that vanishes outside its declared support");
      static_assert(!fits || detail::moments_hold<K>(),
                    "cambium: kernel does not have the moments it declares: sum_j (j - t)^a W(t - j) must be 1 for a = "
                    "0 and 0 for 1 <= a <= moments at every offset t");
      if constexpr (fits) detail::check_optional_statements<K>();
    }
  }
}

}  // namespace cambium
