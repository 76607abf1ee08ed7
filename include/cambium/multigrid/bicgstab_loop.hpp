// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <cambium/core/aligned.hpp>
#include <cambium/parallel/execution.hpp>

namespace cambium::detail {

/// The loop of van der Vorst, Bi-CGSTAB, SIAM J. Sci. Stat. Comput. 13 (1992), preconditioned from the right.
///
/// It differs from Eigen's in what a step of growth needs: its vectors are kept, sweeps over vectors are fused, and it
/// ends in the middle of an iteration if the residual is small enough there. Sums are those of fixed pieces: no number
/// of threads changes a bit.
template <class T, Execution E>
class BiCGStabLoop {
 public:
  explicit BiCGStabLoop(const E& execution = {}) : execution_(execution) {}

  struct End {
    int iterations = 0;
    double residual = 0.0;  ///< norm, as the loop sees it
  };

  /// Improves x, which r = b - A x belongs to, until the norm of the residual is `least`; ends early at a breakdown.
  /// \param note  is called with the norm of the residual after every half of an iteration
  template <class Apply, class Precondition, class Note>
  End operator()(Apply&& apply, Precondition&& precondition, std::span<const T> first_residual, std::span<T> x,
                 double least, int most_iterations, Note&& note) {
    start(first_residual);
    End end{0, std::sqrt(rho_)};
    double rho = 1.0, alpha = 1.0, omega = 1.0;
    while (end.iterations < most_iterations && end.residual > least) {
      if (!(std::abs(rho_) > 1e-30 * end.residual * end.residual)) restart();
      next_direction(end.iterations == 0 ? 0.0 : rho_ / rho * alpha / omega, omega);
      rho = rho_;
      ++end.iterations;
      precondition(p_.data(), y_.data());
      apply(y_.data(), v_.data());
      alpha = rho / sums([&](std::size_t i) { return std::array{hat_[i] * v_[i], T(0)}; })[0];
      end.residual = std::sqrt(sums([&](std::size_t i) {
        r_[i] -= static_cast<T>(alpha) * v_[i];
        return std::array{r_[i] * r_[i], T(0)};
      })[0]);
      note(end.residual);
      if (!(end.residual > least)) {
        each([&](std::size_t i) { x[i] += static_cast<T>(alpha) * y_[i]; });
        break;
      }
      precondition(r_.data(), z_.data());
      apply(z_.data(), t_.data());
      const auto products = sums([&](std::size_t i) { return std::array{t_[i] * r_[i], t_[i] * t_[i]}; });
      omega = products[1] > 0.0 ? products[0] / products[1] : 0.0;
      end.residual = take_both(x, alpha, omega);
      note(end.residual);
      if (!std::isfinite(end.residual) || omega == 0.0) break;
    }
    return end;
  }

 private:
  static constexpr std::size_t piece = 4096;
  static constexpr std::size_t lanes = 8;

  void start(std::span<const T> residual) {
    for (auto* vector : {&r_, &hat_, &p_, &v_, &y_, &z_, &t_}) vector->resize(residual.size());
    partial_.resize((residual.size() + piece - 1) / piece);
    rho_ = sums([&](std::size_t i) {
      r_[i] = hat_[i] = residual[i];
      p_[i] = v_[i] = T(0);
      return std::array{r_[i] * r_[i], T(0)};
    })[0];
  }
  /// The residual has become orthogonal to the first: begins anew from where it is.
  void restart() {
    rho_ = sums([&](std::size_t i) {
      hat_[i] = r_[i];
      p_[i] = v_[i] = T(0);
      return std::array{r_[i] * r_[i], T(0)};
    })[0];
  }
  void next_direction(double beta, double omega) {
    each([&](std::size_t i) { p_[i] = r_[i] + static_cast<T>(beta) * (p_[i] - static_cast<T>(omega) * v_[i]); });
  }
  /// \return norm of the new residual
  double take_both(std::span<T> x, double alpha, double omega) {
    const auto products = sums([&](std::size_t i) {
      x[i] += static_cast<T>(alpha) * y_[i] + static_cast<T>(omega) * z_[i];
      r_[i] -= static_cast<T>(omega) * t_[i];
      return std::array{r_[i] * r_[i], hat_[i] * r_[i]};
    });
    rho_ = products[1];
    return std::sqrt(products[0]);
  }

  template <class F>
  void each(F&& f) {
    for_each_piece(execution_, r_.size(), piece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) f(i);
    });
  }
  /// Both sums of f(i) over all entries.
  template <class F>
  std::array<double, 2> sums(F&& f) {
    for_each_piece(execution_, r_.size(), piece, [&](std::size_t begin, std::size_t end) {
      std::array<T, lanes> first{}, second{};
      std::size_t i = begin;
      for (; i + lanes <= end; i += lanes) {
        for (std::size_t k = 0; k < lanes; ++k) {
          const std::array<T, 2> value = f(i + k);
          first[k] += value[0];
          second[k] += value[1];
        }
      }
      for (; i < end; ++i) {
        const std::array<T, 2> value = f(i);
        first[0] += value[0];
        second[0] += value[1];
      }
      auto& sum = partial_[begin / piece] = {};
      for (std::size_t k = 0; k < lanes; ++k) {
        sum[0] += static_cast<double>(first[k]);
        sum[1] += static_cast<double>(second[k]);
      }
    });
    std::array<double, 2> total{};
    for (const auto& sum : partial_) {
      total[0] += sum[0];
      total[1] += sum[1];
    }
    return total;
  }

  E execution_;
  AlignedVector<T> r_, hat_, p_, v_, y_, z_, t_;
  std::vector<std::array<double, 2>> partial_;
  double rho_ = 1.0;
};

}  // namespace cambium::detail
