// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>

#include <cambium/time/imex_tableaux.hpp>
#include <cambium/time/stability_error.hpp>
#include <cambium/time/state_sums.hpp>
#include <cambium/time/stepper.hpp>

namespace cambium {

/// A right-hand side in two parts, the stiff one linear or at least solved for:
///   rhs.explicit_part(state, t, derivative)        rates that are taken explicitly, e.g. reaction
///   rhs.implicit_part(state, t, derivative)        rates L that are taken implicitly, e.g. diffusion
///   rhs.solve(step, t, right, x)                   x with x - step L(x, t) = right; x holds a first guess
template <class Explicit, class Implicit, class Solve>
struct SplitRate {
  Explicit explicit_part;
  Implicit implicit_part;
  Solve solve;
};
template <class Explicit, class Implicit, class Solve>
SplitRate(Explicit, Implicit, Solve) -> SplitRate<Explicit, Implicit, Solve>;

/// Implicit-explicit Runge-Kutta steps by a tableau (ARS222, ARK3): reaction explicitly, diffusion implicitly. Steps
/// are bound by accuracy and by the stability of the explicit part alone.
///
/// An embedded method if the tableau has an error estimate: attempt() leaves the state alone, accept() takes the
/// result; see Adaptive. Every stage holds two arrays.
template <class S, class Tableau = ARK3, class E = OpenMP>
class IMEX {
 public:
  static constexpr int order = Tableau::order;
  static constexpr int stages = Tableau::stages;
  static constexpr int error_order = Tableau::error_order;

  explicit IMEX(const E& execution = {}) : execution_(execution) { check_state<S>(); }

  /// Advances `state` from t to t + dt. \throws as attempt()
  template <class F>
  void step(StateArgument<S> state, double t, double dt, F&& rhs) {
    attempt(state, t, dt, rhs);
    accept(state);
  }

  /// Computes a step of dt > 0 with d(state)/dt = both parts of rhs, see SplitRate.
  /// \throws ValueError for a dt that is not positive and finite, StabilityError if the explicit part grows beyond all
  ///         bounds; what the parts throw
  template <class F>
  void attempt(const S& state, double t, double dt, F&& rhs) {
    detail::require_step(t, dt);
    fit(state);
    for (std::size_t i = 0; i < count; ++i) {
      const double implicit = table.implicit_part[i][i];
      const double now = t + table.time[i] * dt;
      auto&& y = result_.view();
      auto&& right = right_.view();
      gather(state, dt, table.explicit_part[i], table.implicit_part[i], i, right);
      detail::combine<S>(execution_, y, {1.0}, right);
      auto&& stiff = implicit_rate_[i].view();
      if (implicit > 0.0) {
        require_finite(right, now, dt);
        rhs.solve(implicit * dt, now, StateTraits<S>::const_view(right), y);
        ++solves_;
        const double scale = 1.0 / (implicit * dt);
        detail::combine<S>(execution_, stiff, {scale, -scale}, y, right);
      } else {
        rhs.implicit_part(StateTraits<S>::const_view(y), now, stiff);
        ++evaluations_;
      }
      rhs.explicit_part(StateTraits<S>::const_view(y), now, explicit_rate_[i].view());
      ++evaluations_;
    }
    gather(state, dt, table.explicit_weight, table.implicit_weight, count, result_.view());
    if constexpr (error_order > 0) {
      auto&& error = right_.view();
      gather(state, dt, table.error_weight, table.error_weight, count, error);
      detail::combine<S>(execution_, error, {1.0, -1.0}, error, state);
    }
  }
  /// state := result of the last attempt.
  void accept(StateArgument<S> state) { detail::combine<S>(execution_, state, {1.0}, result_.view()); }
  void reject() {}
  void restart() {}

  decltype(auto) result() { return result_.view(); }
  decltype(auto) error() requires(error_order > 0) { return right_.view(); }
  double longest_step() const { return std::numeric_limits<double>::infinity(); }
  /// Calls of either part, and of solve, so far.
  std::size_t evaluations() const { return evaluations_; }
  std::size_t solves() const { return solves_; }

 private:
  static constexpr std::size_t count = static_cast<std::size_t>(stages);
  static constexpr auto table = Tableau::tableau;

  void fit(const S& state) {
    for (auto* buffer : {&result_, &right_}) buffer->fit(state);
    for (std::size_t i = 0; i < count; ++i) {
      explicit_rate_[i].fit(state);
      implicit_rate_[i].fit(state);
    }
  }
  /// Where the explicit rates of a step that is too long have grown beyond all bounds, there is nothing to solve for.
  template <class Right>
  void require_finite(const Right& right, double t, double dt) const {
    if (std::isfinite(detail::length<S>(execution_, right))) return;
    throw StabilityError(detail::message("a step of ", dt, " grows beyond all bounds by its explicit part, at time ", t,
                                         ": take shorter steps"),
                         dt, 0.1 * dt);
  }
  /// to := state + dt times the first `terms` rates with their weights.
  template <class Row, class To>
  void gather(const S& state, double dt, const Row& of_explicit, const Row& of_implicit, std::size_t terms, To&& to) {
    detail::combine<S>(execution_, to, {1.0}, state);
    for (std::size_t j = 0; j < terms; ++j) {
      detail::combine<S>(execution_, to, {1.0, dt * of_explicit[j], dt * of_implicit[j]}, to, explicit_rate_[j].view(),
                         implicit_rate_[j].view());
    }
  }

  E execution_;
  detail::StageBuffer<S> result_, right_;
  std::array<detail::StageBuffer<S>, count> explicit_rate_, implicit_rate_;
  std::size_t evaluations_ = 0, solves_ = 0;
};

}  // namespace cambium
