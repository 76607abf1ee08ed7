// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include <memory>

#include <cambium/multigrid/level.hpp>

namespace cambium::detail {

/// Direct solution of the equations of the coarsest level, by Eigen's sparse LU decomposition in double precision.
class CoarseSolver {
 public:
  /// \param singular  the constants solve A x = 0: x is zero at the first unknown then
  template <class T, int D>
  CoarseSolver(const Level<T, D>& level, bool singular) {
    std::vector<Eigen::Index> number(level.grid.size(), -1);
    for_each_unknown(level, Serial{},
                     [&](std::size_t at, std::size_t i) { number[at] = static_cast<Eigen::Index>(i); });
    std::vector<Eigen::Triplet<double>> entries;
    level.grid.continue_values(number.data(), Serial{});
    const auto add = [&](std::size_t at, const CutRow<T, D>& row) {
      const Eigen::Index i = number[at];
      entries.emplace_back(i, i, level.diagonal);
      for (std::size_t k = 0; k < row.leg.size(); ++k) {
        const std::ptrdiff_t step = level.grid.stride[static_cast<int>(k / 2)] * (k % 2 == 0 ? -1 : 1);
        const Eigen::Index j = number[at + static_cast<std::size_t>(step)];
        if (j >= 0 && row.leg[k] != T(0)) entries.emplace_back(i, j, -static_cast<double>(row.leg[k]));
      }
    };
    CutRow<T, D> plain{};
    plain.leg.fill(T(1));
    for (const auto& run : level.regular) {
      for (std::ptrdiff_t i = 0; i < run.count; ++i) add(run.at + static_cast<std::size_t>(i), plain);
    }
    for (const auto& rows : level.cut) {
      for (const auto& row : rows) add(row.at, row);
    }
    if (singular) entries.emplace_back(0, 0, 1.0);
    const Eigen::Index n = level.count;
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    decomposition_->compute(matrix);
    if (decomposition_->info() != Eigen::Success) {
      throw ValueError(message("the equations of the coarsest level have no solution (", n,
                               " unknowns): the shift must not be negative"));
    }
    right_.resize(n);
    solution_.resize(n);
  }

  /// x := A^-1 r
  template <class T, int D>
  void operator()(Level<T, D>& level) {
    for_each_unknown(level, Serial{}, [&](std::size_t at, std::size_t i) {
      right_[static_cast<Eigen::Index>(i)] = static_cast<double>(level.r[at]);
    });
    solution_ = decomposition_->solve(right_);
    for_each_unknown(level, Serial{}, [&](std::size_t at, std::size_t i) {
      level.x[at] = static_cast<T>(solution_[static_cast<Eigen::Index>(i)]);
    });
  }

 private:
  using Decomposition = Eigen::SparseLU<Eigen::SparseMatrix<double>>;
  std::unique_ptr<Decomposition> decomposition_ = std::make_unique<Decomposition>();
  Eigen::VectorXd right_, solution_;
};

}  // namespace cambium::detail
