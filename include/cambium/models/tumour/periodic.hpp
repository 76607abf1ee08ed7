// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/models/tumour/jump_pressure.hpp>
#include <cambium/models/tumour/policy.hpp>
#include <cambium/poisson/periodic.hpp>
#include <cambium/poisson/second_order.hpp>

namespace cambium {

/// -Lap p = -(mean of f) outside, in a periodic box: what the tumour gains all of the box loses. The source's; speeds
/// depend on the box. Takes a periodic lattice.
struct Periodic {
  using Kind = tumour_kind::Outside;
  /// Speed that a drop of the pressure with short waves causes, over their wave number.
  static constexpr double mobility = 0.5;

  template <int D, class K>
  class Method : public detail::JumpPressure<D, PeriodicPoisson<D, SecondOrder, double, OpenMP>, K> {
    using Solver = PeriodicPoisson<D, SecondOrder, double, OpenMP>;

   public:
    Method(const Lattice<D>& lattice, double reach, const OpenMP& execution)
        : detail::JumpPressure<D, Solver, K>(lattice, reach, execution,
                                             typename Solver::Params{.mean = MeanPart::subtract}) {}
  };
};

}  // namespace cambium
