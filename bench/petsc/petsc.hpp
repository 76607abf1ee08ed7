// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

/// PETSc beside Cambium: a matrix in, a solution out, so that its headers stay in one translation unit. One thread.
namespace bench::petsc {

/// A square matrix by rows: entries of row i are start[i], ..., start[i + 1] - 1.
struct Matrix {
  std::vector<int> start, column;
  std::vector<double> value;
};

struct Result {
  double setup_seconds = 0.0;  ///< of the preconditioner; the matrix is there already
  double solve_seconds = 0.0;  ///< from zero
  int iterations = 0;
  double residual = 0.0;  ///< relative to the right-hand side
  bool converged = false;
};

/// \param loop            bcgs, gmres, cg, ...
/// \param preconditioner  gamg, hypre (BoomerAMG), ilu, ...; a parameter of hypre is set to what suits 3D problems
Result solve(const Matrix& matrix, const std::vector<double>& right, const std::string& loop,
             const std::string& preconditioner, double tolerance);

}  // namespace bench::petsc
