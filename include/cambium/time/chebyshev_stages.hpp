// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace cambium::detail {

/// Coefficients of the second-order Runge-Kutta-Chebyshev method with s >= 2 stages (Sommeijer, Shampine & Verwer 1997,
/// eq. 2.2 to 2.5), damped by 2 / 13: between its ends the stability polynomial stays below about 1 - 1/39.
class ChebyshevStages {
 public:
  struct Stage {
    double mu, nu, mu_rate, gamma_rate;  ///< of Y_{j-1}, Y_{j-2}, dt F_{j-1}, dt F_0
    double c;                            ///< time of Y_j, in steps
  };

  static constexpr double damping = 2.0 / 13.0;

  /// Stages for a step of dt and the spectral radius: from 2/3 (s^2 - 1)(1 - 2/15 damping), which is the end of the
  /// stability interval to 1% for s >= 5 and below it for all.
  static int count(double step_times_radius) {
    return std::max(2, static_cast<int>(std::ceil(std::sqrt(1.0 + step_times_radius / interval))));
  }
  /// The longest step times spectral radius that count() gives s stages to.
  static double reach(int s) { return interval * (s * static_cast<double>(s) - 1.0); }

  void fit(int s) {
    if (s == static_cast<int>(stage_.size())) return;
    const double w0 = 1.0 + damping / (static_cast<double>(s) * s);
    // T, T', T'' of degrees 0 .. s at w0.
    std::vector<double>&value = polynomial_[0], &first = polynomial_[1], &second = polynomial_[2];
    const auto count = static_cast<std::size_t>(s) + 1;
    if (value.capacity() < count) {
      for (auto* numbers : {&value, &first, &second}) numbers->reserve(2 * count);
      stage_.reserve(2 * count);
    }
    for (auto* numbers : {&value, &first, &second}) numbers->assign(count, 0.0);
    value[0] = 1.0;
    value[1] = w0;
    first[1] = 1.0;
    for (std::size_t j = 2; j < value.size(); ++j) {
      value[j] = 2.0 * w0 * value[j - 1] - value[j - 2];
      first[j] = 2.0 * w0 * first[j - 1] - first[j - 2] + 2.0 * value[j - 1];
      second[j] = 2.0 * w0 * second[j - 1] - second[j - 2] + 4.0 * first[j - 1];
    }
    const double w1 = first.back() / second.back();
    end_ = (1.0 + w0) / w1;
    const auto b = [&](std::size_t j) { return second[j < 2 ? 2 : j] / (first[j < 2 ? 2 : j] * first[j < 2 ? 2 : j]); };
    stage_.resize(static_cast<std::size_t>(s));
    const double c2 = w1 * second[2] / first[2];
    stage_[0] = {1.0, 0.0, b(1) * w1, 0.0, c2 / first[2]};
    for (std::size_t j = 2; j < value.size(); ++j) {
      const double ratio = b(j) / b(j - 1);
      const double rate = 2.0 * w1 * ratio;
      stage_[j - 1] = {2.0 * w0 * ratio, -b(j) / b(j - 2), rate, -(1.0 - b(j - 1) * value[j - 1]) * rate,
                       w1 * second[j] / first[j]};
    }
  }
  const std::vector<Stage>& stages() const { return stage_; }
  /// The end of the stability interval on the real axis.
  double end() const { return end_; }

 private:
  static constexpr double interval = 2.0 / 3.0 * (1.0 - 2.0 / 15.0 * damping);

  std::vector<Stage> stage_;
  std::array<std::vector<double>, 3> polynomial_;  ///< T, T', T'': kept, so that nothing is allocated for fewer stages
  double end_ = 0.0;
};

}  // namespace cambium::detail
