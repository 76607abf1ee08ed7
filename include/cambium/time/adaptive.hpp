// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <cambium/time/stability_error.hpp>
#include <cambium/time/stages.hpp>
#include <cambium/time/state_sums.hpp>
#include <cambium/time/step_size.hpp>

namespace cambium {

/// Options of Adaptive.
struct AdaptiveParams {
  /// A step may err by absolute + relative |c|, in the root mean square over all numbers; c is the state before the
  /// step, as one that grows beyond all bounds would allow itself any error.
  double absolute = 1e-4;
  double relative = 1e-4;
  /// The first step; 0: found from the first rates.
  double first = 0.0;
  double largest = std::numeric_limits<double>::infinity();
  /// Steps grow at most so much from one to the next.
  double growth = 5.0;
  /// Shorter steps, relative to the interval, end in a StabilityError.
  double smallest = 1e-12;
};

/// What the steps of one call did.
struct AdaptiveReport {
  std::size_t steps = 0;
  std::size_t rejected = 0;
  std::size_t evaluations = 0;                      ///< of the right-hand side
  double error = 0.0;                               ///< of the last step, relative to what it was allowed
  StepSize last;                                    ///< the last step and what bound it
  StepSize longest{0.0, Limit::none};               ///< the longest step
  std::array<std::size_t, limit_count> bound_by{};  ///< steps that each limit bound
  std::size_t bound(Limit limit) const { return bound_by[static_cast<std::size_t>(limit)]; }
};

/// Steps of an embedded method (RKC2, IMEX<S, ARK3>, Doubled<RK4, S>) as long as their error allows, by a
/// proportional-integral controller (Gustafsson 1991):
///   dt_next = 0.9 dt err^(-0.7 / p) err_before^(0.4 / p),   err = rms(error / (absolute + relative |c|)), O(dt^p)
template <class Method, class S, class E = OpenMP>
class Adaptive {
 public:
  using Params = AdaptiveParams;

  /// \throws ValueError for options out of range
  explicit Adaptive(Method method, const Params& params = {}, const E& execution = {})
      : method_(std::move(method)), params_(params), execution_(execution), next_(params.first) {
    static_assert(Method::error_order > 0,
                  "cambium: adaptive steps need a method that estimates its error: RKC2, IMEX by ARK3, or any other "
                  "stepper M as Doubled<M, S>");
    if (!(params.absolute >= 0.0) || !(params.relative >= 0.0) || !(params.absolute + params.relative > 0.0) ||
        !(params.first >= 0.0) || !(params.largest > 0.0) || !(params.growth > 1.0) || !(params.smallest > 0.0)) {
      throw ValueError(detail::message("adaptive steps with tolerances ", params.absolute, " and ", params.relative,
                                       ", first step ", params.first, ", largest ", params.largest, ", growth ",
                                       params.growth, " and smallest ", params.smallest,
                                       ": tolerances must not be negative nor both zero, growth above 1, the others "
                                       "positive"));
    }
  }

  /// Advances `state` from t to `end` > t. observe(state, t, StepSize, error), if given, is called after every step.
  /// \throws StabilityError if steps become too short, with the state as after the last step that was accepted; what
  ///         the method throws
  template <class F, class Observe>
  AdaptiveReport advance(StateArgument<S> state, double t, double end, F&& rhs, Observe&& observe) {
    detail::require_step(t, end - t);
    AdaptiveReport report;
    const std::size_t evaluations = method_.evaluations();
    method_.restart();
    const double interval = end - t;
    StepSize step = first_step(state, t, interval, rhs);
    double error_before = 1.0;
    bool rejected = false;
    while (t < end) {
      const StepSize tried = within(step, end - t);
      double error;
      try {
        method_.attempt(state, t, tried.dt, rhs);
        error = error_norm(state);
      } catch (const StabilityError& failure) {
        if (!(failure.limit() > 0.0)) throw;
        error = std::numeric_limits<double>::infinity();
      }
      if (!(error <= 1.0)) {
        method_.reject();
        ++report.rejected;
        rejected = true;
        step = {tried.dt * (std::isfinite(error) ? shrink(error) : 0.1), Limit::rejected};
        if (step.dt < params_.smallest * interval) throw too_short(step.dt, t);
        continue;
      }
      method_.accept(state);
      t = tried.bound == Limit::output ? end : t + tried.dt;
      note(report, tried, error);
      observe(std::as_const(state), t, tried, error);
      step = next_step(step, tried, error, error_before, rejected);
      error_before = std::max(error, 1e-4);
      rejected = false;
    }
    next_ = step.dt;
    report.evaluations = method_.evaluations() - evaluations;
    return report;
  }
  template <class F>
  AdaptiveReport advance(StateArgument<S> state, double t, double end, F&& rhs) {
    return advance(state, t, end, rhs, [](const auto&, double, const StepSize&, double) {});
  }

  Method& method() { return method_; }
  const Params& params() const { return params_; }

 private:
  static constexpr double p = Method::error_order;

  static double shrink(double error) { return std::clamp(0.9 * std::pow(error, -1.0 / p), 0.1, 0.9); }

  StepSize within(const StepSize& step, double left) const {
    StepSize result = step;
    if (params_.largest < result.dt) result = {params_.largest, Limit::given};
    if (const double longest = method_.longest_step(); longest < result.dt) result = {longest, Limit::stability};
    // What is left is not cut into a long and a tiny step.
    if (result.dt >= left) return {left, Limit::output};
    if (2.0 * result.dt > left) result.dt = 0.5 * left;
    return result;
  }
  StepSize next_step(const StepSize& step, const StepSize& tried, double error, double before, bool rejected) const {
    const double bounded = std::max(error, 1e-4);
    const double factor = 0.9 * std::pow(bounded, -0.7 / p) * std::pow(before, 0.4 / p);
    const double limit = rejected ? 1.0 : params_.growth;
    // A step cut short by the end of the interval says nothing against the one that was wanted.
    if (tried.bound == Limit::output && factor >= 1.0 && !rejected) {
      return {std::max(step.dt, tried.dt * std::min(factor, limit)), Limit::accuracy};
    }
    if (factor <= limit) return {tried.dt * factor, Limit::accuracy};
    return {tried.dt * limit, rejected ? Limit::rejected : Limit::growth};
  }
  /// The step whose change is a hundredth of the tolerance's power, or what the last call ended with.
  template <class F>
  StepSize first_step(const S& state, double t, double interval, F&& rhs) {
    if (next_ > 0.0) return {next_, params_.first == next_ ? Limit::given : Limit::accuracy};
    double dt = 1e-3 * interval;
    for (int k = 0; k < 12; ++k) {
      try {
        method_.attempt(state, t, dt, rhs);
        const double error = error_norm(state);
        if (error <= 1.0) {
          return {dt * std::clamp(0.9 * std::pow(std::max(error, 1e-9), -1.0 / p), 1.0, 10.0), Limit::accuracy};
        }
      } catch (const StabilityError& failure) {
        if (!(failure.limit() > 0.0)) throw;
      }
      method_.reject();
      dt *= 0.1;
    }
    throw too_short(dt, t);
  }
  double error_norm(const S& state) {
    auto&& error = method_.error();
    const double sum = detail::sum_numbers<S>(
        execution_,
        [&](double e, double c) {
          const double allowed = params_.absolute + params_.relative * std::abs(c);
          return e * e / (allowed * allowed);
        },
        error, state);
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(detail::count_numbers(state), 1)));
  }
  static void note(AdaptiveReport& report, const StepSize& step, double error) {
    ++report.steps;
    report.error = error;
    report.last = step;
    if (step.dt > report.longest.dt) report.longest = step;
    ++report.bound_by[static_cast<std::size_t>(step.bound)];
  }
  StabilityError too_short(double dt, double t) const {
    return StabilityError(
        detail::message("at time ", t, " steps of ", dt, " still err by more than ", params_.absolute, " + ",
                        params_.relative, " |c|: the solution leaves every bound, or the tolerance is below round-off"),
        dt, 0.0);
  }

  Method method_;
  Params params_;
  E execution_;
  double next_;
};

}  // namespace cambium
