// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/time/doubled.hpp>
#include <cambium/time/rkc2.hpp>

namespace cambium {

/// Ways to step the chemistry of a SurfacePattern in time:
///   typename X::template Method<S, E>   an embedded method, see Adaptive
///   X::rhs(chemistry)                   the right-hand side it takes, of a SurfaceChemistry
/// Diffusion explicitly with as many stages as the step asks: the default.
struct StabilisedSteps {
  template <class S, class E>
  using Method = RKC2<S, E>;

  template <class C>
  static auto rhs(C& chemistry) {
    return [&](const auto& c, double, const auto& rate) { chemistry.rate(c, rate); };
  }
};

/// Any stepper, each step against two of half its length: for comparison.
template <template <class, class> class M>
struct ExplicitSteps {
  template <class S, class E>
  using Method = Doubled<M, S, E>;

  template <class C>
  static auto rhs(C& chemistry) {
    return StabilisedSteps::rhs(chemistry);
  }
};

}  // namespace cambium
