// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <cambium/core/error.hpp>

namespace cambium {

/// What an iterative solver did.
struct SolveReport {
  int iterations = 0;             ///< cycles, or iterations of the Krylov loop
  double residual = 0.0;          ///< norm of the residual relative to that of the right-hand side
  std::vector<double> residuals;  ///< the same on the way, from the first guess on
};

/// An iteration did not reach its tolerance within its bound, or came upon values that are not finite.
class ConvergenceError : public Error {
 public:
  ConvergenceError(const std::string& text, std::vector<double> residuals)
      : Error(text), residuals_(std::move(residuals)) {}

  /// Relative residuals from the first guess on.
  const std::vector<double>& residuals() const { return residuals_; }

 private:
  std::vector<double> residuals_;
};

}  // namespace cambium
