// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <concepts>
#include <type_traits>

#include <cambium/core/error.hpp>
#include <cambium/core/vec.hpp>
#include <cambium/kernels/radial_moments.hpp>

namespace cambium {

/// True if mollifier Z is defined in D dimensions.
template <class Z, int D>
concept MollifierIn = requires {
  { Z::template radial<D>(0.5) } -> std::convertible_to<double>;
};

/// A mollifier zeta that turns particles into a smooth field, q(x) = sum_p Q_p zeta_eps(x - x_p): a plain struct with
///   static constexpr int order       r: integral of zeta is 1, of x^alpha zeta is 0 for 0 < |alpha| < r
///   static constexpr double cutoff   zeta is negligible for rho >= cutoff (in units of eps)
///   template <int D> static constexpr double radial(double rho2)   zeta(x) for |x|^2 = rho2, in the D it is made for
/// Eldredge, Leonard & Colonius (J. Comput. Phys. 180 (2002) 686); eqs. 11.2-11.7 of the growth papers.
template <class Z>
concept Mollifier = (MollifierIn<Z, 1> || MollifierIn<Z, 2> || MollifierIn<Z, 3>)&&requires {
  { Z::order } -> std::convertible_to<int>;
  { Z::cutoff } -> std::convertible_to<double>;
};

namespace detail {

/// True if radial<D> is a constant expression, or Z is not made for D dimensions.
template <class Z, int D>
consteval bool mollifier_is_constant() {
  if constexpr (MollifierIn<Z, D>) {
    return requires { typename std::bool_constant<(Z::template radial<D>(0.5) == Z::template radial<D>(0.5))>; };
  } else {
    return true;
  }
}

/// True if the moments are those of the declared order, or Z is not made for D dimensions.
template <class Z, int D>
consteval bool mollifier_moments_hold() {
  if constexpr (MollifierIn<Z, D>) {
    constexpr int count = (Z::order + 1) / 2;
    const auto found = radial_moments<D, count>([](double rho2) { return Z::template radial<D>(rho2); }, Z::cutoff);
    for (int m = 0; m < count; ++m) {
      if (!nearly(found.moment[m], m == 0 ? 1.0 : 0.0)) return false;
    }
  }
  return true;
}

}  // namespace detail

/// Checks at compile time what a mollifier declares of itself, one readable message for each statement.
template <class Z>
constexpr void check_mollifier() {
  static_assert(Mollifier<Z>,
                "cambium: a mollifier needs static constexpr int order, double cutoff and radial<D>(rho2); see "
                "docs/concepts/Mollifier.md");
  if constexpr (Mollifier<Z>) {
    constexpr bool sane = Z::order >= 1 && Z::order <= 8 && Z::cutoff > 0.0;
    static_assert(sane, "cambium: mollifier order must be between 1 and 8, its cutoff positive (in units of eps)");
    constexpr bool constant = detail::mollifier_is_constant<Z, 1>() && detail::mollifier_is_constant<Z, 2>() &&
                              detail::mollifier_is_constant<Z, 3>();
    static_assert(constant,
                  "cambium: mollifier radial<D>(rho2) must be a constant expression; cambium/kernels/constant_math.hpp "
                  "has an exponential that is");
    if constexpr (sane && constant) {
      static_assert(detail::mollifier_moments_hold<Z, 1>() && detail::mollifier_moments_hold<Z, 2>() &&
                        detail::mollifier_moments_hold<Z, 3>(),
                    "cambium: mollifier does not have the order it declares: its integral must be 1 and the moments of "
                    "degree 1, ..., order - 1 must vanish");
    }
  }
}

/// zeta_eps(x) = eps^-D zeta(x / eps); zero from the cutoff radius on.
/// \param epsilon  smoothing length, in the units of x
/// \throws ValueError unless epsilon is positive and finite
template <Mollifier Z, int D>
double scaled_mollifier(const Vec<D>& x, double epsilon) {
  if (!(epsilon > 0.0) || !std::isfinite(epsilon)) {
    throw ValueError(detail::message("smoothing length is ", epsilon, ": it must be a positive, finite length"));
  }
  const double rho2 = dot(x, x) / (epsilon * epsilon);
  if (rho2 >= Z::cutoff * Z::cutoff) return 0.0;
  return Z::template radial<D>(rho2) / product(Vec<D>::constant(epsilon));
}

}  // namespace cambium
