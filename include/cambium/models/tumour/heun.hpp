// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/core/sparse.hpp>
#include <cambium/models/tumour/policy.hpp>
#include <cambium/parallel/execution.hpp>

namespace cambium {

/// Explicit steps of second order with two evaluations each: Heun's, the mean of the speeds at the beginning and after
/// an Euler step. Bound by the stiffness of the surface tension.
struct Heun {
  using Kind = tumour_kind::Stepping;
  static constexpr bool keeps_speed = false;
  static constexpr double real_axis = 2.0;

  template <int D>
  class Method {
   public:
    explicit Method(const Lattice<D>&) {}
    template <class L, class Growth, class Move>
    int operator()(L& level_set, const L& start, Growth& growth, const Field<double, D, Sparse>&, double dt, double,
                   Field<double, D, Sparse>& rate, Move&& move, const OpenMP& execution) {
      rate = growth.speed();
      move(rate);
      growth.evaluate(level_set, dt);
      const auto& later = growth.speed();
      for_each_piece(execution, rate.blocks(), 1, [&](std::size_t b, std::size_t) {
        const std::ptrdiff_t other = later.find(rate.block_index(b));
        if (other < 0) return;
        const auto values = later.block(static_cast<std::size_t>(other));
        for (std::size_t i = 0; i < values.size(); ++i) {
          double& v = rate.block(b)[i];
          if (!std::isnan(values[i])) v = 0.5 * (v + values[i]);
        }
      });
      level_set = start;
      move(rate);
      return 0;
    }
  };
};

}  // namespace cambium
