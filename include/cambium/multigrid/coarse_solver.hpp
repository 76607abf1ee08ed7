// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include <cambium/multigrid/eigen.hpp>
#include <cambium/multigrid/matrix_entries.hpp>

namespace cambium::detail {

/// Direct solution of the equations of the coarsest level in double precision: by Eigen's sparse LU decomposition, or
/// by a dense one where there are few unknowns, which takes no memory when it is applied.
class CoarseSolver {
 public:
  /// \param singular  the constants solve A x = 0: x is zero at the first unknown then
  template <class T, int D>
  CoarseSolver(const Level<T, D>& level, bool singular) {
    std::vector<Eigen::Triplet<double>> entries;
    for_each_entry(level, [&](std::ptrdiff_t i, std::ptrdiff_t j, double value) { entries.emplace_back(i, j, value); });
    if (singular) entries.emplace_back(0, 0, 1.0);
    const Eigen::Index n = level.count;
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    if (!decompose(matrix)) {
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
    if (decomposition_) {
      solution_ = decomposition_->solve(right_);
    } else {
      solution_ = dense_.solve(right_);
    }
    for_each_unknown(level, Serial{}, [&](std::size_t at, std::size_t i) {
      level.x[at] = static_cast<T>(solution_[static_cast<Eigen::Index>(i)]);
    });
  }

 private:
  /// Unknowns up to which the matrix is dense: 0.3 MB, 1 ms.
  static constexpr Eigen::Index few = 200;
  using Decomposition = Eigen::SparseLU<Eigen::SparseMatrix<double>>;

  /// \return false if the matrix has no inverse
  bool decompose(const Eigen::SparseMatrix<double>& matrix) {
    if (matrix.rows() <= few) {
      dense_.compute(Eigen::MatrixXd(matrix));
      return dense_.matrixLU().diagonal().cwiseAbs().minCoeff() > 0.0 && dense_.matrixLU().allFinite();
    }
    decomposition_ = std::make_unique<Decomposition>();
    decomposition_->compute(matrix);
    return decomposition_->info() == Eigen::Success;
  }

  std::unique_ptr<Decomposition> decomposition_;
  Eigen::PartialPivLU<Eigen::MatrixXd> dense_;
  Eigen::VectorXd right_, solution_;
};

}  // namespace cambium::detail
