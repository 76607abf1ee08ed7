// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/core/sparse.hpp>
#include <cambium/models/tumour/policy.hpp>
#include <cambium/parallel/execution.hpp>

namespace cambium {

namespace detail {

/// rate := V + part (V - V_before); V where nothing is known of before.
/// \param before  speeds at nodes of another band, NaN where there is none
template <int D>
void extrapolate_speed(const Field<double, D, Sparse>& speed, const Field<double, D, Sparse>& before, double part,
                       Field<double, D, Sparse>& rate, const OpenMP& execution) {
  rate = speed;
  if (part == 0.0) return;
  for_each_piece(execution, rate.blocks(), 1, [&](std::size_t b, std::size_t) {
    const std::ptrdiff_t old = before.find(rate.block_index(b));
    if (old < 0) return;
    const auto values = before.block(static_cast<std::size_t>(old));
    for (std::size_t i = 0; i < values.size(); ++i) {
      double& v = rate.block(b)[i];
      if (!std::isnan(values[i])) v += part * (v - values[i]);
    }
  });
}

}  // namespace detail

/// Explicit steps of second order with one evaluation each: Adams and Bashforth's, V + dt / (2 dt_before) (V -
/// V_before), the first being Euler's. Bound by the stiffness of the surface tension. The speed of the last step is
/// kept.
struct AdamsBashforth {
  using Kind = tumour_kind::Stepping;
  static constexpr bool keeps_speed = true;
  /// -dt lambda that steps keep to, lambda being the fastest rate of decay. The rule is stable up to 1; the curvature
  /// on the lattice has waves that are faster than lambda, along diagonals.
  static constexpr double real_axis = 0.5;

  template <int D>
  class Method {
   public:
    explicit Method(const Lattice<D>&) {}
    /// Calls move(rate), which moves the level set, once. \param growth  evaluated at the level set
    template <class L, class Growth, class Move>
    int operator()(L&, const L&, Growth& growth, const Field<double, D, Sparse>& before, double dt, double dt_before,
                   Field<double, D, Sparse>& rate, Move&& move, const OpenMP& execution) {
      detail::extrapolate_speed(growth.speed(), before, dt_before > 0.0 ? 0.5 * dt / dt_before : 0.0, rate, execution);
      move(rate);
      return 0;
    }
  };
};

}  // namespace cambium
