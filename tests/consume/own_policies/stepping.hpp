// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/core/sparse.hpp>
#include <cambium/models/tumour/policy.hpp>
#include <cambium/parallel/execution.hpp>

/// Euler's steps, of first order: TumourPolicy of the kind Stepping.
struct ForwardEuler {
  using Kind = cambium::tumour_kind::Stepping;
  static constexpr bool keeps_speed = false;
  static constexpr double real_axis = 2.0;

  template <int D>
  class Method {
   public:
    explicit Method(const cambium::Lattice<D>&) {}

    template <class L, class Growth, class Speed, class Move>
    int operator()(L&, const L&, Growth& growth, const Speed&, double, double, Speed& rate, Move&& move,
                   const cambium::OpenMP&) const {
      rate = growth.speed();
      move(rate);
      return 0;
    }
  };
};
