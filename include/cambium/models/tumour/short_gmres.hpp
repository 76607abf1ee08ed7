// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <cambium/multigrid/convergence_error.hpp>
#include <cambium/parallel/execution.hpp>

namespace cambium::detail {

/// GMRES without restart from x = 0, for operators so dear that one product an iteration, and none for residuals, is
/// what counts: few iterations to a loose tolerance. Keeps a vector for each.
class ShortGMRES {
 public:
  using Vector = std::vector<double>;

  /// \param apply  apply(in, out) for vectors of the size of `right`. \return iterations
  /// \throws ConvergenceError if `most` iterations do not bring the residual below `tolerance` times that of x = 0
  template <class Apply>
  int operator()(Apply&& apply, const Vector& right, Vector& x, double tolerance, int most, const OpenMP& execution) {
    x.assign(right.size(), 0.0);
    const double start = std::sqrt(dot(right, right, execution));
    std::vector<double> residuals{1.0};
    if (!(start > 0.0)) return 0;
    basis_.resize(static_cast<std::size_t>(most) + 1);
    columns_.clear();
    turns_.clear();
    small_ = {start};
    basis_[0] = right;
    scale(basis_[0], 1.0 / start);
    for (int k = 0; k < most; ++k) {
      extend(apply, static_cast<std::size_t>(k), execution);
      residuals.push_back(std::abs(small_.back()) / start);
      if (!std::isfinite(residuals.back())) break;
      if (residuals.back() <= tolerance) {
        combine(x);
        return k + 1;
      }
    }
    throw ConvergenceError(
        message("the stiff part of the surface tension is solved to ", residuals.back(), " after ", most,
                " iterations and was to be to ", tolerance, ": allow more iterations or take shorter steps"),
        residuals);
  }

 private:
  static double dot(const Vector& a, const Vector& b, const OpenMP& execution) {
    return reduce(
        execution, a.size(), 0.0, [&](std::size_t i) { return a[i] * b[i]; }, [](double s, double t) { return s + t; });
  }
  static void scale(Vector& a, double factor) {
    for (double& value : a) value *= factor;
  }
  /// One more vector of the basis and column of the Hessenberg matrix, made triangular by rotations.
  template <class Apply>
  void extend(Apply&& apply, std::size_t k, const OpenMP& execution) {
    Vector& next = basis_[k + 1];
    next.resize(basis_[k].size());
    apply(basis_[k], next);
    std::vector<double> column(k + 2);
    for (std::size_t j = 0; j <= k; ++j) {
      column[j] = dot(next, basis_[j], execution);
      for_each(execution, next.size(), [&](std::size_t i) { next[i] -= column[j] * basis_[j][i]; });
    }
    column[k + 1] = std::sqrt(dot(next, next, execution));
    if (column[k + 1] > 0.0) scale(next, 1.0 / column[k + 1]);
    for (std::size_t j = 0; j < k; ++j) {
      const double above = turns_[j].first * column[j] + turns_[j].second * column[j + 1];
      column[j + 1] = turns_[j].first * column[j + 1] - turns_[j].second * column[j];
      column[j] = above;
    }
    const double length = std::hypot(column[k], column[k + 1]);
    turns_.emplace_back(column[k] / length, column[k + 1] / length);
    column[k] = length;
    columns_.push_back(column);
    small_.push_back(-turns_[k].second * small_[k]);
    small_[k] *= turns_[k].first;
  }
  void combine(Vector& x) {
    for (std::size_t k = columns_.size(); k-- > 0;) {
      const double weight = small_[k] /= columns_[k][k];
      for (std::size_t j = 0; j < k; ++j) small_[j] -= weight * columns_[k][j];
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += weight * basis_[k][i];
    }
  }

  std::vector<Vector> basis_;
  std::vector<std::vector<double>> columns_;
  std::vector<std::pair<double, double>> turns_;
  std::vector<double> small_;
};

}  // namespace cambium::detail
