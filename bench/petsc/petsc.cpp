// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/petsc.hpp"

#include <petscksp.h>
#include <stdexcept>

#include "support/clock.hpp"

namespace bench::petsc {
namespace {

/// PETSc is set up at the first call and stays: it cannot be set up twice.
void start() {
  PetscBool there = PETSC_FALSE;
  PetscInitialized(&there);
  if (there) return;
  if (PetscInitializeNoArguments() != 0) throw std::runtime_error("PETSc cannot be set up");
  PetscOptionsSetValue(nullptr, "-pc_hypre_boomeramg_strong_threshold", "0.5");
  PetscOptionsSetValue(nullptr, "-pc_hypre_boomeramg_coarsen_type", "HMIS");
  PetscOptionsSetValue(nullptr, "-pc_hypre_boomeramg_interp_type", "ext+i");
}
void require(PetscErrorCode code) {
  if (code != 0) throw std::runtime_error("a call of PETSc has failed");
}

}  // namespace

Result solve(const Matrix& matrix, const std::vector<double>& right, const std::string& loop,
             const std::string& preconditioner, double tolerance) {
  start();
  auto starts = matrix.start;
  auto columns = matrix.column;
  auto values = matrix.value;
  auto b = right;
  std::vector<double> solution(right.size(), 0.0), image(right.size());
  const auto size = static_cast<PetscInt>(right.size());
  Mat a = nullptr;
  Vec rhs = nullptr, x = nullptr, ax = nullptr;
  KSP ksp = nullptr;
  PC pc = nullptr;
  require(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, size, size, starts.data(), columns.data(), values.data(), &a));
  require(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, size, b.data(), &rhs));
  require(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, size, solution.data(), &x));
  require(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, size, image.data(), &ax));
  require(KSPCreate(PETSC_COMM_SELF, &ksp));
  require(KSPSetOperators(ksp, a, a));
  require(KSPSetType(ksp, loop.c_str()));
  require(KSPGetPC(ksp, &pc));
  require(PCSetType(pc, preconditioner.c_str()));
  if (loop != "cg") require(KSPSetPCSide(ksp, PC_RIGHT));
  require(KSPSetNormType(ksp, KSP_NORM_UNPRECONDITIONED));
  require(KSPSetTolerances(ksp, tolerance, 0.0, 1e10, 2000));
  require(KSPSetFromOptions(ksp));
  Result result;
  const double before = cpu_seconds();
  require(KSPSetUp(ksp));
  result.setup_seconds = cpu_seconds() - before;
  const double between = cpu_seconds();
  require(KSPSolve(ksp, rhs, x));
  result.solve_seconds = cpu_seconds() - between;
  KSPConvergedReason reason{};
  PetscInt iterations = 0;
  PetscReal norm = 0.0, scale = 0.0;
  require(KSPGetConvergedReason(ksp, &reason));
  require(KSPGetIterationNumber(ksp, &iterations));
  require(MatMult(a, x, ax));
  require(VecAXPY(ax, -1.0, rhs));
  require(VecNorm(ax, NORM_2, &norm));
  require(VecNorm(rhs, NORM_2, &scale));
  result.iterations = static_cast<int>(iterations);
  result.residual = norm / scale;
  result.converged = reason > 0;
  KSPDestroy(&ksp);
  for (auto* vector : {&rhs, &x, &ax}) VecDestroy(vector);
  MatDestroy(&a);
  return result;
}

}  // namespace bench::petsc
