// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <span>

#include <cambium/time/stages.hpp>
#include <cambium/time/state_sums.hpp>

namespace cambium {

/// Estimates the spectral radius of the Jacobian of a right-hand side by the nonlinear power iteration of RKC
/// (Sommeijer, Shampine & Verwer 1997): differences of the right-hand side along a direction that the next call starts
/// from.
template <class S, class E = OpenMP>
class SpectralRadius {
 public:
  struct Params {
    double change = 0.01;  ///< relative, of the estimate between iterations, at which they end
    double safety = 1.2;   ///< what is given back over the last estimate
    int most_iterations = 60;
  };

  explicit SpectralRadius(const E& execution = {}) : execution_(execution) {}
  SpectralRadius(const Params& params, const E& execution) : params_(params), execution_(execution) {}

  /// \param rate  the right-hand side at `state` and t
  /// \return the estimate with its safety, 0 if nothing changes; NaN if the right-hand side is not finite. The largest
  ///         modulus, be the eigenvalue real or not
  template <class Rate, class F>
  double operator()(const S& state, double t, const Rate& rate, F&& rhs) {
    fit(state);
    auto&& direction = direction_.view();
    auto&& y = near_.view();
    auto&& f = rate_.view();
    const double size = detail::length<S>(execution_, state);
    const double small = std::sqrt(epsilon) * (size > 0.0 ? size : 1.0);
    double radius = 0.0;
    for (int iteration = 0; iteration < params_.most_iterations; ++iteration) {
      const double scale = small / detail::length<S>(execution_, direction);
      detail::combine<S>(execution_, y, {1.0, scale}, state, direction);
      rhs(StateTraits<S>::const_view(y), t, f);
      ++evaluations_;
      detail::combine<S>(execution_, f, {1.0, -1.0}, f, rate);
      const double before = radius, change = detail::length<S>(execution_, f);
      radius = change / small;
      if (!std::isfinite(radius)) {
        started_ = false;
        return std::numeric_limits<double>::quiet_NaN();
      }
      if (change == 0.0) return 0.0;
      detail::combine<S>(execution_, direction, {1.0 / change}, f);
      if (iteration > 0 && std::abs(radius - before) <= params_.change * radius) break;
    }
    return params_.safety * radius;
  }
  std::size_t evaluations() const { return evaluations_; }

 private:
  static constexpr double epsilon = std::numeric_limits<double>::epsilon();

  /// The first direction has a part of every mode: numbers between -1 and 1 without a pattern.
  void fit(const S& state) {
    const bool same = started_ && count_ == detail::count_numbers(state);
    for (auto* buffer : {&direction_, &near_, &rate_}) buffer->fit(state);
    if (same) return;
    auto&& direction = direction_.view();
    std::uint32_t number = 1;
    std::apply(
        [&](const auto&... array) {
          const auto fill = [&](const auto& values) {
            for (auto& value : values) {
              using V = std::remove_cvref_t<decltype(value)>;
              for (int c = 0; c < Components<V>::count; ++c) {
                number = number * 1664525U + 1013904223U;
                component(value, c) = static_cast<ScalarOf<V>>(static_cast<double>(number) * 0x1p-31 - 1.0);
              }
            }
          };
          (fill(array), ...);
        },
        StateTraits<S>::arrays(direction));
    count_ = detail::count_numbers(state);
    started_ = true;
  }

  Params params_;
  E execution_;
  detail::StageBuffer<S> direction_, near_, rate_;
  std::size_t count_ = 0;
  bool started_ = false;
  std::size_t evaluations_ = 0;
};

}  // namespace cambium
