// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Error against time of Dirichlet problems on the interface: -Lap c = f in a ball of radius 0.35 in the unit box with a
// smooth manufactured solution, by several Krylov loops and multigrid cycles and by others' solvers of the same
// equations; a step of growth that starts from the solutions before; and how errors depend on where the lattice cuts
// the shape. Times are processor times of one thread, best of several runs, in units of one pair: a forward and an
// inverse real Fourier transform of as many cells, in the same run.
//
//     work_precision_dirichlet --json raw.json     then scripts/draw_work_precision_dirichlet.py raw.json
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/multigrid/chebyshev.hpp>

#include "dirichlet/growth.hpp"
#include "dirichlet/peers.hpp"
#include "dirichlet/shifts.hpp"
#include "support/command.hpp"
#include "support/pair.hpp"

using namespace cambium;

namespace bench {
namespace {

using BallScene = Scene<3, Ball<3>>;

template <class Krylov, class S>
void run(const char* name, const BallScene& scene, int smoothings, double tolerance, double pair,
         nlohmann::json& table) {
  using Solver = Dirichlet<3, double, Krylov, S>;
  typename Solver::Params params;
  params.before = params.after = smoothings;
  params.tolerance = tolerance;
  Solver solver(scene.level_set.band(), params, OpenMP{1});
  Field<double, 3> c(scene.lattice);
  SolveReport report;
  const double setup = best_of(3, [&] { solver.update(scene.level_set.band()); });
  const double solve = best_of(3, [&] {
    c.fill(0.0);
    report = solver.solve(scene.f, BallScene::Problem::value, c);
  });
  Field<double, 3, Sparse> derivative(scene.lattice);
  const auto& points = scene.level_set.method().points();
  const double gradient = best_of(3, [&] { solver.normal_derivative(scene.level_set.band(), points, c, derivative); });
  const auto cells = scene.lattice.nodes()[0] - 1;
  nlohmann::json entry{{"method", name},
                       {"cells", cells},
                       {"smoothings", smoothings},
                       {"tolerance", tolerance},
                       {"pair_seconds", pair},
                       {"setup_pairs", setup / pair},
                       {"solve_pairs", solve / pair},
                       {"setup_seconds", setup},
                       {"solve_seconds", solve},
                       {"derivative_pairs", gradient / pair},
                       {"iterations", report.iterations},
                       {"value_error", scene.value_error(solver, c)},
                       {"derivative_error", scene.derivative_error(derivative)}};
  std::printf("%-24s %4td cells  V(%d,%d)  tol %.0e  setup %5.2f  solve %5.2f (%d)  dc/dn %5.2f  errors %.2e %.2e\n",
              name, cells, smoothings, smoothings, tolerance, setup / pair, solve / pair, report.iterations,
              gradient / pair, entry["value_error"].get<double>(), entry["derivative_error"].get<double>());
  for (const bool two : {false, true}) {
    const Growth growth = run_growth<Solver>(scene.lattice, params, two);
    const double warm = growth.update_seconds + growth.solve_seconds;
    entry[two ? "growth_two" : "growth_one"] = {
        {"update_pairs", growth.update_seconds / pair},     {"solve_pairs", growth.solve_seconds / pair},
        {"continue_pairs", growth.continue_seconds / pair}, {"iterations", growth.iterations},
        {"cold_pairs", growth.cold_seconds / pair},         {"cold_iterations", growth.cold_iterations}};
    std::printf("    growth, guess of %d: update %.2f + solve %.2f (%d), %.0f%% of cold %.2f (%d); continued in %.2f\n",
                two ? 2 : 1, growth.update_seconds / pair, growth.solve_seconds / pair, growth.iterations,
                100.0 * warm / growth.cold_seconds, growth.cold_seconds / pair, growth.cold_iterations,
                growth.continue_seconds / pair);
  }
  std::fflush(stdout);
  table.push_back(entry);
}

/// `smoke`: one method, so that a test of the program compiles in seconds.
template <bool smoke>
void run_methods(const std::vector<std::ptrdiff_t>& resolutions, nlohmann::json& table, nlohmann::json& others) {
  constexpr double tolerance = 1e-8;
  for (const std::ptrdiff_t cells : resolutions) {
    const double pair = pair_seconds(cells);
    std::printf("pair of %td cells: %.4f s\n", cells, pair);
    const BallScene scene(Lattice<3>::bounded_box(Box<3>::cube(), cells), Ball<3>(Vec<3>::constant(0.5), 0.35));
    run<BiCGStab, RedBlack>("BiCGStab, RedBlack", scene, 2, tolerance, pair, table);
    if constexpr (!smoke) {
      run<BiCGStab, RedBlack>("BiCGStab, RedBlack", scene, 1, tolerance, pair, table);
      run<BiCGStab, Chebyshev<2>>("BiCGStab, Chebyshev<2>", scene, 1, tolerance, pair, table);
      run<GMRES<12>, RedBlack>("GMRES<12>, RedBlack", scene, 1, tolerance, pair, table);
      Peers<Ball<3>> peers(scene, tolerance, pair, others);
      peers.run_plain();
      peers.run_eigen();
#if WITH_PETSC
      for (const char* preconditioner : {"gamg", "hypre", "ilu"}) peers.run_petsc("bcgs", preconditioner);
      peers.run_petsc("gmres", "hypre");
      peers.run_petsc("gmres", "gamg");
      peers.run_petsc("cg", "gamg");
#endif
    }
  }
}

template <bool smoke>
void run_all_shifts(int flat, int deep, nlohmann::json& table) {
  if (flat > 0) run_shifts<2>("ellipse", Ellipsoid<2>{{0.37, 0.25}}, flat, 32, table);
  if constexpr (!smoke) {
    if (flat > 0) run_shifts<2>("circle", Ellipsoid<2>{{0.31, 0.31}}, flat, 32, table);
    if (flat > 0) run_shifts<2>("star", Star{}, flat, 64, table);
    if (deep > 0) run_shifts<3>("sphere", Ellipsoid<3>{{0.31, 0.31, 0.31}}, deep, 32, table);
    if (deep > 0) run_shifts<3>("ellipsoid", Ellipsoid<3>{{0.37, 0.25, 0.3}}, deep, 32, table);
  }
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  std::vector<std::ptrdiff_t> resolutions{32, 64, 128};
  int shifts = 1000, deep_shifts = 100;
  bench::Command command("Error against time of Dirichlet problems on an interface");
  command.app.add_option("--resolutions", resolutions, "cells along an axis");
  command.app.add_option("--shifts", shifts, "random shifts of the lattice in 2D");
  command.app.add_option("--shifts-3d", deep_shifts, "random shifts of the lattice in 3D");
  CLI11_PARSE(command.app, argc, argv);
  if (command.quick) {
    resolutions = {24};
    shifts = 5;
  }
  constexpr bool smoke = BENCH_SMOKE != 0;
  nlohmann::json table = nlohmann::json::array(), others = table, cuts = table;
  bench::run_methods<smoke>(resolutions, table, others);
  bench::run_all_shifts<smoke>(shifts, deep_shifts, cuts);
  command.write({{"runs", table}, {"others", others}, {"cuts", cuts}});
  return 0;
}
