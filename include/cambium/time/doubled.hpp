// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>

#include <cambium/time/spectral_radius.hpp>
#include <cambium/time/stability_error.hpp>
#include <cambium/time/stepper.hpp>

namespace cambium {

/// Any stepper M as an embedded method: every step is taken once whole and once in two halves, whose difference over
/// 2^order - 1 is the error of the halves. Steps that the method's stability interval does not allow are not offered:
/// longest_step() comes from an estimate of the spectral radius.
template <template <class, class> class M, class S, class E = OpenMP>
class Doubled {
 public:
  using Method = M<S, E>;
  static constexpr int order = Method::order;
  static constexpr int error_order = order + 1;

  explicit Doubled(const E& execution = {}) : execution_(execution), method_(execution), estimate_(execution) {}

  /// Computes a step of dt > 0, as step() of the method would. \throws what that throws
  template <class F>
  void attempt(const S& state, double t, double dt, F&& rhs) {
    for (auto* buffer : {&whole_, &halves_}) {
      buffer->fit(state);
      detail::combine<S>(execution_, buffer->view(), {1.0}, state);
    }
    const auto counted = [&](const auto& y, double time, auto&& rate) {
      ++evaluations_;
      rhs(y, time, rate);
    };
    find_limit(state, t, counted);
    auto&& whole = whole_.view();
    auto&& halves = halves_.view();
    method_.step(whole, t, dt, counted);
    method_.step(halves, t, 0.5 * dt, counted);
    method_.step(halves, t + 0.5 * dt, 0.5 * dt, counted);
    const double scale = 1.0 / ((1 << order) - 1);
    detail::combine<S>(execution_, whole, {scale, -scale}, halves, whole);
  }
  void accept(StateArgument<S> state) {
    detail::combine<S>(execution_, state, {1.0}, halves_.view());
    ++steps_;
  }
  void reject() { steps_ = 0; }
  void restart() { steps_ = 0; }

  decltype(auto) result() { return halves_.view(); }
  decltype(auto) error() { return whole_.view(); }
  /// Twice what the method itself takes; infinite before the first attempt.
  double longest_step() const {
    return radius_ > 0.0 ? 2.0 * Method::real_axis / radius_ : std::numeric_limits<double>::infinity();
  }
  std::size_t evaluations() const { return evaluations_; }

 private:
  static constexpr std::size_t estimate_every = 25;

  template <class F>
  void find_limit(const S& state, double t, F&& rhs) {
    if (steps_ % estimate_every != 0) return;
    rate_.fit(state);
    auto&& rate = rate_.view();
    rhs(StateTraits<S>::const_view(state), t, rate);
    radius_ = estimate_(state, t, rate, rhs);
    if (!std::isfinite(radius_)) {
      throw StabilityError(detail::message("the right-hand side is not finite at time ", t,
                                           ": the state has left what it is defined for"),
                           0.0, 0.0);
    }
  }

  E execution_;
  Method method_;
  SpectralRadius<S, E> estimate_;
  detail::StageBuffer<S> whole_, halves_, rate_;
  double radius_ = 0.0;
  std::size_t steps_ = 0, evaluations_ = 0;
};

}  // namespace cambium
