// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>

#include <cambium/time/spectral_radius.hpp>
#include <cambium/time/stability_error.hpp>
#include <cambium/time/stepper.hpp>

namespace cambium {

/// Steps of one length by an explicit stepper M, each checked: a step beyond the end of the stability interval is
/// refused before anything grows, and one whose result is not finite is not taken.
template <template <class, class> class M, class S, class E = OpenMP>
class FixedSteps {
 public:
  using Method = M<S, E>;

  struct Params {
    /// Steps after which the spectral radius is estimated again.
    int check_every = 100;
  };

  explicit FixedSteps(const E& execution = {}) : FixedSteps(Params{}, execution) {}
  /// \throws ValueError for options out of range
  explicit FixedSteps(const Params& params, const E& execution = {})
      : params_(params),
        execution_(execution),
        method_(execution),
        estimate_({.change = 1e-3, .safety = 1.0, .most_iterations = 200}, execution) {
    if (params.check_every < 1) {
      throw ValueError(
          detail::message("stability is to be checked every ", params.check_every, " steps: at least 1 is needed"));
    }
  }

  /// Advances `state` by `count` steps of dt from t. \return the number of calls of rhs
  /// \throws StabilityError, with the state as after the last step taken, if dt times the spectral radius is beyond the
  ///         method's real_axis or the state would become infinite; as step() of the method
  template <class F>
  std::size_t advance(StateArgument<S> state, double t, double dt, std::size_t count, F&& rhs) {
    detail::require_step(t, dt);
    next_.fit(state);
    rate_.fit(state);
    std::size_t evaluations = 0;
    const auto counted = [&](const auto& y, double time, auto&& rate) {
      ++evaluations;
      rhs(y, time, rate);
    };
    for (std::size_t n = 0; n < count; ++n) {
      const double now = t + static_cast<double>(n) * dt;
      if (n % static_cast<std::size_t>(params_.check_every) == 0) require_stable(state, now, dt, counted);
      auto&& next = next_.view();
      detail::combine<S>(execution_, next, {1.0}, state);
      method_.step(next, now, dt, counted);
      if (!std::isfinite(detail::length<S>(execution_, next))) {
        throw StabilityError(detail::message("a step of ", dt, " at time ", now,
                                             " leads to values that are not finite: take shorter ones"),
                             dt, limit_);
      }
      detail::combine<S>(execution_, state, {1.0}, next);
    }
    return evaluations;
  }
  /// The longest stable step at the last check.
  double limit() const { return limit_; }

 private:
  template <class F>
  void require_stable(const S& state, double t, double dt, F&& rhs) {
    auto&& rate = rate_.view();
    rhs(StateTraits<S>::const_view(state), t, rate);
    const double radius = estimate_(state, t, rate, rhs);
    limit_ = Method::real_axis / radius;
    if (dt <= limit_) return;
    throw StabilityError(detail::message("a step of ", dt, " at time ", t, " is beyond the stability limit ", limit_,
                                         ", ", Method::real_axis, " over the spectral radius ", radius,
                                         ": take shorter steps, RKC2, or an implicit method"),
                         dt, limit_);
  }

  Params params_;
  E execution_;
  Method method_;
  SpectralRadius<S, E> estimate_;
  detail::StageBuffer<S> next_, rate_;
  double limit_ = 0.0;
};

}  // namespace cambium
