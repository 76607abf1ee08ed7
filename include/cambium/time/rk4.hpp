// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/time/stepper.hpp>

namespace cambium {

/// The classical four-stage, fourth-order Runge-Kutta method (Kutta 1901).
template <class S, Execution E = OpenMP>
class RK4 {
 public:
  static constexpr int order = 4;
  static constexpr int stages = 4;
  static constexpr double ssp = 0.0;
  static constexpr double real_axis = 2.7852935634;
  static constexpr double imaginary_axis = 2.8284271247;

  explicit RK4(const E& execution = {}) : execution_(execution) { check_state<S>(); }
  /// Makes the buffers for states of the shape of `state`; the type of the state follows from it.
  explicit RK4(const S& state, const E& execution = {}) : RK4(execution) { fit(state); }

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
      auto&& sum = sum_.view();
      rhs(StateTraits<S>::const_view(state), t, sum);
      detail::combine<S>(execution_, y, {1.0, 0.5 * dt}, state, sum);
      for (const double reach : {0.5 * dt, dt}) {
        rhs(StateTraits<S>::const_view(y), t + 0.5 * dt, k);
        detail::combine<S>(execution_, sum, {1.0, 2.0}, sum, k);
        detail::combine<S>(execution_, y, {1.0, reach}, state, k);
      }
      rhs(StateTraits<S>::const_view(y), t + dt, k);
      detail::combine<S>(execution_, state, {1.0, dt / 6.0, dt / 6.0}, state, sum, k);
    }
  }

 private:
  void fit(const S& state) {
    stage_.fit(state);
    derivative_.fit(state);
    sum_.fit(state);
  }

  E execution_;
  detail::StageBuffer<S> stage_;
  detail::StageBuffer<S> derivative_;
  detail::StageBuffer<S> sum_;
};

}  // namespace cambium
