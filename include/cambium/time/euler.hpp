// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/time/stepper.hpp>

namespace cambium {

/// Forward Euler: y + dt f(y).
template <class S, Execution E = OpenMP>
class Euler {
 public:
  static constexpr int order = 1;
  static constexpr int stages = 1;
  static constexpr double ssp = 1.0;
  static constexpr double real_axis = 2.0;
  static constexpr double imaginary_axis = 0.0;

  explicit Euler(const E& execution = {}) : execution_(execution) { check_state<S>(); }
  /// Makes the buffers for states of the shape of `state`; the type of the state follows from it.
  explicit Euler(const S& state, const E& execution = {}) : Euler(execution) { fit(state); }

  /// Advances `state` from t to t + dt, dt > 0, with d(state)/dt = rhs(state, t), called as rhs(state, t, derivative).
  /// \throws ValueError for a dt that is not positive and finite, SizeError if rhs changed the size of the derivative;
  ///         the state is then unchanged, and so it is if rhs throws
  template <class F>
  void step(StateArgument<S> state, double t, double dt, F&& rhs) {
    if constexpr (detail::check_rhs<S, F>()) {
      detail::require_step(t, dt);
      fit(state);
      auto&& k = derivative_.view();
      rhs(StateTraits<S>::const_view(state), t, k);
      detail::combine<S>(execution_, state, {1.0, dt}, state, k);
    }
  }

 private:
  void fit(const S& state) { derivative_.fit(state); }

  E execution_;
  detail::StageBuffer<S> derivative_;
};

}  // namespace cambium
