// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <cambium/core/aligned.hpp>
#include <cambium/core/vec.hpp>
#include <cambium/parallel/execution.hpp>
#include <cambium/simd/pack.hpp>

namespace cambium {
namespace detail {

/// exp(-x) I_n(x), n = 0, ..., result.size() - 1, x > 0: Miller's backward recurrence, normalised by
/// exp(x) = I_0 + 2 I_1 + 2 I_2 + ..., or Hankel's expansion where x is much larger than n.
inline void scaled_bessel_i(double x, std::vector<double>& result) {
  const std::size_t last = result.size() - 1;
  const auto order = static_cast<double>(last);
  if (x > 3e4 * (order + 1.0)) {
    for (std::size_t n = 0; n <= last; ++n) {
      const double mu = 4.0 * static_cast<double>(n) * static_cast<double>(n);
      double term = 1.0, sum = 1.0;
      for (int k = 1; k < 40 && std::abs(term) > 1e-18; ++k) {
        term *= ((2.0 * k - 1.0) * (2.0 * k - 1.0) - mu) / (8.0 * k * x);
        sum += term;
      }
      result[n] = sum / std::sqrt(2.0 * std::numbers::pi * x);
    }
    return;
  }
  // Beyond this order the values are below round-off of the sum.
  std::size_t n = last + 30 + static_cast<std::size_t>(std::sqrt(80.0 * x + 100.0));
  double above = 0.0, value = 1e-280, sum = 0.0;
  for (;; --n) {
    if (n <= last) result[n] = value;
    sum += n > 0 ? 2.0 * value : value;
    if (n == 0) break;
    const double below = above + 2.0 * static_cast<double>(n) / x * value;
    above = value;
    value = below;
    if (value > 1e250) {
      for (double* number : {&value, &above, &sum}) *number *= 1e-250;
      for (std::size_t k = n; k <= last; ++k) result[k] *= 1e-250;
    }
  }
  for (double& number : result) number /= sum;
}

/// Nodes and weights of the Gauss-Legendre rule of 16 points on [-1, 1], by Newton's method.
inline std::array<std::array<double, 2>, 16> gauss_legendre_16() {
  constexpr int points = 16;
  std::array<std::array<double, 2>, points> rule;
  for (int i = 0; i < points; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (points + 0.5));
    double slope = 1.0;
    for (int iteration = 0; iteration < 20; ++iteration) {
      double before = 1.0, value = x;
      for (int k = 2; k <= points; ++k) {
        before = std::exchange(value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
      }
      slope = points * (x * value - before) / (x * x - 1.0);
      x -= value / slope;
    }
    rule[static_cast<std::size_t>(i)] = {x, 2.0 / ((1.0 - x * x) * slope * slope)};
  }
  return rule;
}

/// A rule for integrals over t > 0 of products of exp(-2 t) I_n(2 t), n <= order: Gauss-Legendre on [0, 1/2], [1/2, 1],
/// [1, 2], [2, 4], ..., and in u = 1 / sqrt(t) beyond 4 order^2, where the products are smooth in u.
struct HeatRule {
  std::vector<double> weight;
  std::vector<std::vector<double>> value;  ///< of exp(-2 t) I_n(2 t): of node q, for each n

  explicit HeatRule(std::size_t order) {
    const auto rule = gauss_legendre_16();
    const auto add = [&](double t, double w) {
      weight.push_back(w);
      scaled_bessel_i(2.0 * t, value.emplace_back(order + 1));
    };
    const double far = 4.0 * static_cast<double>(order) * static_cast<double>(order);
    double from = 0.0, to = 0.5;
    for (; from == 0.0 || from < far || from < 4.0; from = std::exchange(to, 2.0 * to)) {
      for (const auto& [x, w] : rule) add(0.5 * (from + to) + 0.5 * (to - from) * x, 0.5 * (to - from) * w);
    }
    const double end = 1.0 / std::sqrt(from);
    for (const auto& [x, w] : rule) {
      const double u = 0.5 * end * (1.0 + x);
      add(1.0 / (u * u), end * w / (u * u * u));
    }
  }
};

}  // namespace detail

/// The lattice Green's function: what decays (D = 3) or grows like a logarithm (D = 2) at infinity with
///   sum over the 2 D neighbours m of n of (G(n) - G(m)) = 1 at n = 0, 0 elsewhere.
///
/// G(n) = integral over t > 0 of prod_d exp(-2 t) I_(n_d)(2 t); for D = 2, where that diverges, of this less its value
/// at n = 0, so that G(0) = 0, G(1, 0) = -1/4, G(1, 1) = -1/pi, and -G(n) tends to (log|n| + gamma + 1.5 log 2) / (2
/// pi). \param count  numbers of n_d = 0, 1, ... along each axis; axis 0 is the fastest of the result Source:
/// Martinsson, Rodin (2002), Proc. R. Soc. A 458; Liska, Colonius (2014), J. Comput. Phys. 277.
template <int D, Execution E = OpenMP>
AlignedVector<double> lattice_green(const Index<D>& count, const E& execution = {}) {
  static_assert(D == 2 || D == 3, "cambium::lattice_green: made for two and three dimensions");
  using Lanes = simd::Pack<double, 8>;
  std::ptrdiff_t most = 1;
  for (int d = 0; d < D; ++d) most = std::max(most, count[d]);
  const detail::HeatRule rule(static_cast<std::size_t>(most - 1) + 8);
  const auto width = static_cast<std::size_t>(count[0]);
  AlignedVector<double> result(static_cast<std::size_t>(product(count)));
  for_each_piece(execution, result.size() / width, 8, [&](std::size_t begin, std::size_t end) {
    std::vector<double> factor(rule.weight.size());
    for (std::size_t row = begin; row < end; ++row) {
      for (std::size_t q = 0; q < factor.size(); ++q) {
        factor[q] = rule.weight[q];
        auto rest = static_cast<std::ptrdiff_t>(row);
        for (int d = 1; d < D; rest /= count[d], ++d) {
          factor[q] *= rule.value[q][static_cast<std::size_t>(rest % count[d])];
        }
      }
      for (std::size_t i = 0; i < width; i += Lanes::lanes) {
        Lanes sum(0.0);
        for (std::size_t q = 0; q < factor.size(); ++q) {
          Lanes term = Lanes::load(rule.value[q].data() + i) * Lanes(factor[q]);
          if constexpr (D == 2) {
            const double origin = rule.value[q][0];
            term = term - Lanes(rule.weight[q] * origin * origin);
          }
          sum = sum + term;
        }
        std::array<double, Lanes::lanes> values;
        sum.store(values.data());
        std::copy_n(values.begin(), std::min(Lanes::lanes, width - i),
                    result.begin() + static_cast<std::ptrdiff_t>(row * width + i));
      }
    }
  });
  return result;
}

}  // namespace cambium
