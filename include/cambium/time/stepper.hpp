// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/time/stages.hpp>

namespace cambium {

/// A one-step method for d(state)/dt = rhs(state, t): a class template over the state with
///   static constexpr int order, stages
///   static constexpr double ssp              largest c so that a step of c dt is monotone where Euler's of dt is
///   static constexpr double real_axis        the step z = dt lambda is stable for -real_axis <= z <= 0
///   static constexpr double imaginary_axis   and for z = i y, |y| <= imaginary_axis
///   step(state, t, dt, rhs)                  advances the state from t to t + dt; leaves it unchanged if it throws
template <class M, class S>
concept Stepper = State<S> && requires(M& method, S& state) {
  { M::order } -> std::convertible_to<int>;
  { M::stages } -> std::convertible_to<int>;
  { M::ssp } -> std::convertible_to<double>;
  { M::real_axis } -> std::convertible_to<double>;
  { M::imaginary_axis } -> std::convertible_to<double>;
  method.step(state, 0.0, 1.0, [](const auto&, double, auto&&) {});
};

/// Checks at compile time that M advances states of type S, one readable message for each requirement.
template <class M, class S>
constexpr void check_stepper() {
  check_state<S>();
  if constexpr (State<S>) {
    static_assert(Stepper<M, S>,
                  "cambium: a stepper needs static constexpr order, stages, ssp, real_axis and imaginary_axis, and "
                  "step(state, t, dt, rhs) for the state; see docs/concepts/Stepper.md");
  }
}

}  // namespace cambium
