// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include <cambium/core/error.hpp>
#include <cambium/kernels/radial_moments.hpp>

namespace cambium {

/// True if PSE kernel K is defined in D dimensions.
template <class K, int D>
concept PSEKernelIn = requires {
  { K::template laplacian<D>(0.5) } -> std::convertible_to<double>;
  { K::template gradient<D>(0.5) } -> std::convertible_to<double>;
  { K::template zeroth_moment<D> } -> std::convertible_to<double>;
};

/// A kernel of particle strength exchange, radial, in units of eps: a plain struct with
///   static constexpr int order               order of accuracy in eps
///   static constexpr double cutoff           pairs with rho >= cutoff are left out
///   static constexpr double largest_spacing  largest advisable h / eps: beyond it the sum over a lattice has an error
///                                            that does not fall with eps
///   template <int D> static constexpr double zeroth_moment            M_0 = integral of eta
///   template <int D> static constexpr double laplacian(double rho2)   eta
///   template <int D> static constexpr double gradient(double rho2)    g, with eta_i(x) = x_i g
/// in the dimensions D it is made for. Signs, with eta_eps(x) = eps^-D eta(x / eps):
///   Lap q(x) ~ eps^-2 integral (q(y) - q(x)) eta_eps(x - y) dy,      integral of x_i^2 eta = 2
///   d_i q(x) ~ eps^-1 integral (q(y) + q(x)) eta_i,eps(x - y) dy,    integral of x_i eta_i = -1
/// Degond & Mas-Gallic (Math. Comp. 53 (1989) 485); Eldredge, Leonard & Colonius (J. Comput. Phys. 180 (2002) 686).
template <class K>
concept PSEKernel = (PSEKernelIn<K, 1> || PSEKernelIn<K, 2> || PSEKernelIn<K, 3>)&&requires {
  { K::order } -> std::convertible_to<int>;
  { K::cutoff } -> std::convertible_to<double>;
  { K::largest_spacing } -> std::convertible_to<double>;
};

namespace detail {

/// Moments 1, rho^2, ..., rho^(2 m) with 2 m <= max(order, 2); higher ones need not exist.
template <class K>
inline constexpr int pse_moment_count = (K::order < 2 ? 2 : K::order) / 2 + 1;

/// True if moments rho^4, rho^6, ... of f vanish.
template <class Moments>
constexpr bool higher_moments_vanish(const Moments& moments) {
  for (std::size_t m = 2; m < moments.moment.size(); ++m) {
    if (!nearly(moments.moment[m], 0.0)) return false;
  }
  return true;
}

/// The first statement of a PSE kernel that does not hold.
enum class PSEFault { none, not_constant, scale, order, gradient, zeroth_moment, cutoff };

template <class K, int D>
constexpr PSEFault pse_fault_in() {
  if constexpr (!PSEKernelIn<K, D>) {
    return PSEFault::none;
  } else if constexpr (!requires {
                         typename std::bool_constant<(K::template laplacian<D>(0.5) < 1e300)>;
                         typename std::bool_constant<(K::template gradient<D>(0.5) < 1e300)>;
                       }) {
    return PSEFault::not_constant;
  } else {
    constexpr int count = pse_moment_count<K>;
    const auto eta = radial_moments<D, count>([](double rho2) { return K::template laplacian<D>(rho2); }, K::cutoff);
    if (!nearly(eta.moment[1] / D, 2.0)) return PSEFault::scale;
    if (!higher_moments_vanish(eta)) return PSEFault::order;
    const auto g = radial_moments<D, count>([](double rho2) { return K::template gradient<D>(rho2); }, K::cutoff);
    if (!nearly(g.moment[1] / D, -1.0) || !higher_moments_vanish(g)) return PSEFault::gradient;
    if (!nearly(eta.moment[0], K::template zeroth_moment<D>)) return PSEFault::zeroth_moment;
    return eta.outside <= 2e-3 * D ? PSEFault::none : PSEFault::cutoff;
  }
}

template <class K>
constexpr PSEFault pse_fault() {
  const PSEFault fault[] = {pse_fault_in<K, 1>(), pse_fault_in<K, 2>(), pse_fault_in<K, 3>()};
  return fault[0] != PSEFault::none ? fault[0] : fault[1] != PSEFault::none ? fault[1] : fault[2];
}

}  // namespace detail

/// Checks at compile time what a PSE kernel declares of itself; the message names the first statement that fails.
template <class K>
constexpr void check_pse_kernel() {
  using detail::PSEFault;
  static_assert(PSEKernel<K>,
                "cambium: a PSE kernel needs static constexpr int order, double cutoff, double largest_spacing, "
                "laplacian<D>(rho2), gradient<D>(rho2) and zeroth_moment<D>; see docs/concepts/PSEKernel.md");
  if constexpr (PSEKernel<K>) {
    constexpr bool sane = K::order >= 1 && K::order <= 8 && K::cutoff > 0.0 && K::largest_spacing > 0.0;
    static_assert(sane,
                  "cambium: PSE kernel order must be between 1 and 8, cutoff and largest_spacing positive (in units of "
                  "eps)");
    if constexpr (sane) {
      constexpr PSEFault fault = detail::pse_fault<K>();
      static_assert(fault != PSEFault::not_constant,
                    "cambium: PSE kernel laplacian<D>(rho2) and gradient<D>(rho2) must be constant expressions; "
                    "cambium/kernels/constant_math.hpp has an exponential that is");
      static_assert(fault != PSEFault::scale,
                    "cambium: PSE kernel has the wrong scale: the integral of x_i^2 laplacian must be 2");
      static_assert(fault != PSEFault::order,
                    "cambium: PSE kernel does not have the order it declares: the moments of laplacian of degree "
                    "3, ..., order + 1 must vanish");
      static_assert(fault != PSEFault::gradient,
                    "cambium: PSE kernel gradient does not have the order it declares: the integral of x_i eta_i must "
                    "be -1 and the other moments of degree 0, ..., order must vanish");
      static_assert(fault != PSEFault::zeroth_moment,
                    "cambium: PSE kernel zeroth_moment is not the integral of laplacian");
      static_assert(fault != PSEFault::cutoff,
                    "cambium: PSE kernel cutoff is too small: more than 0.1 % of the second moment lies outside");
    }
  }
}

/// Largest time step for which explicit Euler is stable with dq/dt = diffusivity Lap_eps q:
/// diffusivity dt M_0 / eps^2 <= 2.
///
/// Exact for the integral operator if the symbol of the kernel increases to M_0 (the Gaussian ones do). A lattice sum
/// with h / eps <= largest_spacing differs from M_0 by less than 1e-6 of it (2e-4 for Algebraic2).
/// \throws ValueError unless diffusivity and epsilon are positive and finite
template <class K, int D>
requires PSEKernelIn<K, D>
double largest_euler_step(double diffusivity, double epsilon) {
  if (!(diffusivity > 0.0) || !std::isfinite(diffusivity) || !(epsilon > 0.0) || !std::isfinite(epsilon)) {
    throw ValueError(detail::message("diffusivity is ", diffusivity, " and smoothing length ", epsilon,
                                     ": both must be positive and finite"));
  }
  return 2.0 * epsilon * epsilon / (diffusivity * K::template zeroth_moment<D>);
}

}  // namespace cambium
