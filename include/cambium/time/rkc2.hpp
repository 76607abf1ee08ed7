// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <cambium/time/chebyshev_stages.hpp>
#include <cambium/time/spectral_radius.hpp>
#include <cambium/time/stability_error.hpp>
#include <cambium/time/stepper.hpp>

namespace cambium {

/// Options of RKC2.
struct RKC2Params {
  /// Spectral radius of the Jacobian; 0: estimated, and again after `estimate_every` steps or a rejected one.
  double spectral_radius = 0.0;
  int estimate_every = 25;
  /// Longer steps are refused: round-off is amplified by about s^2.
  int most_stages = 1000;
};

/// The stabilised explicit method of second order RKC (Sommeijer, Shampine & Verwer 1997) for diffusion and reaction,
/// whose eigenvalues lie near the negative real axis: s stages take a step of 0.653 (s^2 - 1) over the spectral radius,
/// s^2 / 3 times Euler's for s times its work. The spectral radius is estimated on the way.
///
/// An embedded method: attempt() leaves the state alone, accept() takes the result; see Adaptive.
template <class S, class E = OpenMP>
class RKC2 {
 public:
  static constexpr int order = 2;
  static constexpr int stages = 0;  ///< as many as the step asks
  static constexpr double ssp = 0.0;
  static constexpr double real_axis = std::numeric_limits<double>::infinity();
  static constexpr double imaginary_axis = 0.0;
  /// The error estimate is O(dt^error_order).
  static constexpr int error_order = 3;

  using Params = RKC2Params;

  explicit RKC2(const E& execution = {}) : RKC2(Params{}, execution) {}
  /// \throws ValueError for options out of range
  explicit RKC2(const Params& params, const E& execution = {})
      : params_(params), execution_(execution), estimate_(execution) {
    check_state<S>();
    if (!(params.spectral_radius >= 0.0) || !std::isfinite(params.spectral_radius) || params.estimate_every < 1 ||
        params.most_stages < 2) {
      throw ValueError(detail::message("RKC2 with spectral radius ", params.spectral_radius, ", estimated every ",
                                       params.estimate_every, " steps, and at most ", params.most_stages,
                                       " stages: they must be finite and not negative, above 0 and at least 2"));
    }
  }
  /// Makes the buffers for states of the shape of `state`; the type of the state follows from it.
  explicit RKC2(const S& state, const E& execution = {}) : RKC2(execution) { fit(state); }

  /// Advances `state` from t to t + dt. \throws as attempt()
  template <class F>
  void step(StateArgument<S> state, double t, double dt, F&& rhs) {
    restart();
    attempt(state, t, dt, rhs);
    accept(state);
  }

  /// Computes a step of dt > 0 with d(state)/dt = rhs(state, t), called as rhs(state, t, derivative), and its error.
  /// \throws ValueError for a dt that is not positive and finite, SizeError if rhs changed the size of the derivative,
  ///         StabilityError if the step takes more than Params::most_stages or the right-hand side is not finite
  template <class F>
  void attempt(const S& state, double t, double dt, F&& rhs) {
    if constexpr (detail::check_rhs<S, F>()) {
      detail::require_step(t, dt);
      fit(state);
      start(state, t, rhs);
      const double radius = find_radius(state, t, rhs);
      const int s = detail::ChebyshevStages::count(dt * radius);
      if (!(dt * radius < detail::ChebyshevStages::reach(params_.most_stages))) {
        throw StabilityError(
            detail::message("a step of ", dt, " at time ", t, " with spectral radius ", radius, " takes more than ",
                            params_.most_stages, " stages: take shorter steps, or check what the state has become"),
            dt, longest_step());
      }
      run(state, t, dt, s, rhs);
    }
  }
  /// state := result of the last attempt.
  void accept(StateArgument<S> state) {
    detail::combine<S>(execution_, state, {1.0}, buffer_[result_].view());
    std::swap(start_rate_, rate_);
    ++steps_;
    rejected_ = false;
  }
  /// The last attempt is not taken: the next is shorter.
  void reject() { rejected_ = true; }
  /// To be called when the state or the right-hand side have changed since the last step.
  void restart() { started_ = false; }

  /// Result and estimated error (eq. 2.6) of the last attempt.
  decltype(auto) result() { return buffer_[result_].view(); }
  decltype(auto) error() { return buffer_[previous_].view(); }
  /// The longest step of the stages allowed; infinite before the first attempt.
  double longest_step() const {
    return radius_ > 0.0 ? 0.999 * detail::ChebyshevStages::reach(params_.most_stages) / radius_
                         : std::numeric_limits<double>::infinity();
  }
  double spectral_radius() const { return radius_; }
  int last_stages() const { return static_cast<int>(coefficients_.stages().size()); }
  /// Calls of the right-hand side so far.
  std::size_t evaluations() const { return evaluations_ + estimate_.evaluations(); }

 private:
  void fit(const S& state) {
    for (auto& buffer : buffer_) buffer.fit(state);
  }
  template <class F>
  void start(const S& state, double t, F&& rhs) {
    if (started_) return;
    rhs(StateTraits<S>::const_view(state), t, buffer_[start_rate_].view());
    ++evaluations_;
    started_ = true;
    estimated_at_ = none;
  }
  template <class F>
  double find_radius(const S& state, double t, F&& rhs) {
    if (params_.spectral_radius > 0.0) return radius_ = params_.spectral_radius;
    const bool old =
        estimated_at_ == none || steps_ >= estimated_at_ + static_cast<std::size_t>(params_.estimate_every);
    if (old || (rejected_ && estimated_at_ != steps_)) {
      radius_ = estimate_(state, t, buffer_[start_rate_].view(), rhs);
      estimated_at_ = steps_;
      if (!std::isfinite(radius_)) {
        estimated_at_ = none;
        throw StabilityError(detail::message("the right-hand side is not finite at time ", t,
                                             ": the state has left what it is defined for"),
                             0.0, 0.0);
      }
    }
    return radius_;
  }
  template <class F>
  void run(const S& state, double t, double dt, int s, F&& rhs) {
    coefficients_.fit(s);
    auto&& rate = buffer_[rate_].view();
    auto&& start = buffer_[start_rate_].view();
    const auto& stage = coefficients_.stages();
    detail::combine<S>(execution_, buffer_[previous_].view(), {1.0}, state);
    detail::combine<S>(execution_, buffer_[result_].view(), {1.0, stage[0].mu_rate * dt}, state, start);
    for (std::size_t j = 1; j < stage.size(); ++j) {
      auto&& before = buffer_[previous_].view();
      auto&& y = buffer_[result_].view();
      rhs(StateTraits<S>::const_view(y), t + stage[j - 1].c * dt, rate);
      const auto& [mu, nu, mu_rate, gamma_rate, c] = stage[j];
      detail::combine<S>(execution_, before, {mu, nu, 1.0 - mu - nu, mu_rate * dt, gamma_rate * dt}, y, before, state,
                         rate, start);
      std::swap(previous_, result_);
    }
    auto&& y = buffer_[result_].view();
    rhs(StateTraits<S>::const_view(y), t + dt, rate);
    evaluations_ += stage.size();
    detail::combine<S>(execution_, buffer_[previous_].view(), {0.8, -0.8, 0.4 * dt, 0.4 * dt}, state, y, start, rate);
  }

  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  Params params_;
  E execution_;
  SpectralRadius<S, E> estimate_;
  detail::ChebyshevStages coefficients_;
  std::array<detail::StageBuffer<S>, 4> buffer_;
  std::size_t start_rate_ = 0, rate_ = 1, result_ = 2, previous_ = 3;  ///< which buffer is which
  double radius_ = 0.0;
  std::size_t steps_ = 0, estimated_at_ = none, evaluations_ = 0;
  bool started_ = false, rejected_ = false;
};

}  // namespace cambium
