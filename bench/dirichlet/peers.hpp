// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include <cambium/multigrid/eigen.hpp>
#include <cambium/multigrid/krylov.hpp>

#include "dirichlet/equations.hpp"
#include "support/best_of.hpp"

namespace bench {

/// Others' solvers of the same equations, to the same residual.
template <class Shape>
class Peers {
 public:
  Peers(const Scene<3, Shape>& scene, double tolerance, double pair, nlohmann::json& table)
      : equations_(scene), cells_(scene.lattice.nodes()[0] - 1), tolerance_(tolerance), pair_(pair), table_(table) {}

  /// The Krylov loop alone: the diagonal of the rows is constant, so that it preconditions nothing.
  void run_plain() {
    const auto apply = [&](const double* in, double* out) { equations_.apply(in, out); };
    const auto same = [&](const double* in, double* out) { std::copy_n(in, equations_.right.size(), out); };
    std::vector<double> x(equations_.right.size());
    int iterations = 0;
    const double seconds = best_of(1, [&] {
      std::ranges::fill(x, 0.0);
      iterations = solve_krylov<BiCGStab, double>(apply, same, std::span<const double>(equations_.right), std::span(x),
                                                  {tolerance_, 2000})
                       .iterations;
    });
    note("BiCGStab, diagonal", 0.0, seconds, iterations);
  }
  void run_eigen() {
    using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    const auto& from = equations_.matrix;
    const auto size = static_cast<Eigen::Index>(equations_.right.size());
    const Matrix matrix = Eigen::Map<const Matrix>(size, size, static_cast<Eigen::Index>(from.value.size()),
                                                   from.start.data(), from.column.data(), from.value.data());
    const Eigen::Map<const Eigen::VectorXd> right(equations_.right.data(), size);
    Eigen::BiCGSTAB<Matrix, Eigen::IncompleteLUT<double>> solver;
    solver.preconditioner().setFillfactor(4);
    solver.preconditioner().setDroptol(1e-3);
    solver.setTolerance(tolerance_);
    const double setup = best_of(1, [&] { solver.compute(matrix); });
    Eigen::VectorXd x;
    const double seconds = best_of(1, [&] { x = solver.solve(right); });
    note("Eigen BiCGSTAB, IncompleteLUT", setup, seconds, static_cast<int>(solver.iterations()));
  }
#if WITH_PETSC
  void run_petsc(const std::string& loop, const std::string& preconditioner) {
    petsc::Result best;
    for (int k = 0; k < 2; ++k) {
      const auto result = petsc::solve(equations_.matrix, equations_.right, loop, preconditioner, tolerance_);
      if (k == 0 || result.setup_seconds + result.solve_seconds < best.setup_seconds + best.solve_seconds)
        best = result;
    }
    const std::string name = "PETSc " + loop + ", " + preconditioner;
    if (!best.converged || best.residual > 2.0 * tolerance_) {
      std::printf("%-32s does not converge: residual %.1e\n", name.c_str(), best.residual);
      return;
    }
    note(name, best.setup_seconds, best.solve_seconds, best.iterations);
  }
#endif

 private:
  void note(const std::string& name, double setup, double solve, int iterations) {
    table_.push_back({{"method", name},
                      {"cells", cells_},
                      {"tolerance", tolerance_},
                      {"setup_pairs", setup / pair_},
                      {"solve_pairs", solve / pair_},
                      {"setup_seconds", setup},
                      {"solve_seconds", solve},
                      {"iterations", iterations}});
    std::printf("%-32s %4td cells  setup %7.2f  solve %7.2f (%d)\n", name.c_str(), cells_, setup / pair_, solve / pair_,
                iterations);
    std::fflush(stdout);
  }

  Equations<Shape> equations_;
  std::ptrdiff_t cells_;
  double tolerance_;
  double pair_;
  nlohmann::json& table_;
};

}  // namespace bench
