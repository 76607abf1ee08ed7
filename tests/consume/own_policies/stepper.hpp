// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include <cambium/core/error.hpp>
#include <cambium/time/stepper.hpp>

/// The midpoint rule for states that are vectors of numbers: Stepper. Buffers are kept from step to step.
template <class S>
class Midpoint {
 public:
  static constexpr int order = 2;
  static constexpr int stages = 2;
  static constexpr double ssp = 0.0;
  static constexpr double real_axis = 2.0;
  static constexpr double imaginary_axis = 0.0;

  template <class F>
  void step(S& state, double t, double dt, F&& rhs) {
    if (!(dt > 0.0) || !std::isfinite(dt)) throw cambium::ValueError("a step must be positive and finite");
    rate_.resize(state.size());
    middle_.resize(state.size());
    rhs(static_cast<const S&>(state), t, rate_);
    for (std::size_t i = 0; i < state.size(); ++i) middle_[i] = state[i] + 0.5 * dt * rate_[i];
    rhs(static_cast<const S&>(middle_), t + 0.5 * dt, rate_);
    for (std::size_t i = 0; i < state.size(); ++i) state[i] += dt * rate_[i];
  }

 private:
  S rate_, middle_;
};
