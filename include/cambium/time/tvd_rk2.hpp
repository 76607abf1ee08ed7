// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/time/stepper.hpp>

namespace cambium {

/// Two-stage, second-order Runge-Kutta method that keeps the total variation (Shu & Osher 1988): convex combinations of
/// Euler steps, so it is monotone wherever Euler is.
template <class S, Execution E = OpenMP>
class TVDRK2 {
 public:
  static constexpr int order = 2;
  static constexpr int stages = 2;
  static constexpr double ssp = 1.0;
  static constexpr double real_axis = 2.0;
  static constexpr double imaginary_axis = 0.0;

  explicit TVDRK2(const E& execution = {}) : execution_(execution) { check_state<S>(); }
  /// Makes the buffers for states of the shape of `state`; the type of the state follows from it.
  explicit TVDRK2(const S& state, const E& execution = {}) : TVDRK2(execution) { fit(state); }

  /// Advances `state` from t to t + dt, dt > 0, with d(state)/dt = rhs(state, t), called as rhs(state, t, derivative).
  /// \throws ValueError for a dt that is not positive and finite, SizeError if rhs changed the size of the derivative;
  ///         the state is then unchanged, and so it is if rhs throws
  template <class F>
  void step(StateArgument<S> state, double t, double dt, F&& rhs) {
    if constexpr (detail::check_rhs<S, F>()) {
      detail::require_step(t, dt);
      fit(state);
      auto&& y = stage_.view();
      auto&& k = derivative_.view();
      rhs(StateTraits<S>::const_view(state), t, k);
      detail::combine<S>(execution_, y, {1.0, dt}, state, k);
      rhs(StateTraits<S>::const_view(y), t + dt, k);
      detail::combine<S>(execution_, state, {0.5, 0.5, 0.5 * dt}, state, y, k);
    }
  }

 private:
  void fit(const S& state) {
    stage_.fit(state);
    derivative_.fit(state);
  }

  E execution_;
  detail::StageBuffer<S> stage_;
  detail::StageBuffer<S> derivative_;
};

}  // namespace cambium
