// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Error against time of Dirichlet problems on the interface: -Lap c = f in a ball of radius 0.35 in the unit box with a
// smooth manufactured solution, by several Krylov loops and multigrid cycles, and how the errors of a problem in 2D
// depend on where the lattice cuts the shape. Times are processor times of one thread, best of several runs, in units
// of one pair: a forward and an inverse real Fourier transform of as many cells, in the same run.
//
//     work_precision_dirichlet --json raw.json
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include <cambium/interface/dirichlet.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/multigrid/chebyshev.hpp>
#include <cambium/poisson/periodic_transform.hpp>

#include "support/clock.hpp"

using namespace cambium;

namespace bench {
namespace {

/// exp(x) sin(2 y + z) + x^2 z, z = 0.3 in 2D
template <int D>
struct Problem {
  static double height(const Vec<D>& x) { return D == 3 ? x[D - 1] : 0.3; }
  static double value(const Vec<D>& x) {
    return std::exp(x[0]) * std::sin(2.0 * x[1] + height(x)) + x[0] * x[0] * height(x);
  }
  static Vec<D> gradient(const Vec<D>& x) {
    const double e = std::exp(x[0]);
    const double angle = 2.0 * x[1] + height(x);
    Vec<D> result;
    result[0] = e * std::sin(angle) + 2.0 * x[0] * height(x);
    result[1] = 2.0 * e * std::cos(angle);
    if (D == 3) result[D - 1] = e * std::cos(angle) + x[0] * x[0];
    return result;
  }
  static double right_side(const Vec<D>& x) {
    return (D == 3 ? 4.0 : 3.0) * std::exp(x[0]) * std::sin(2.0 * x[1] + height(x)) - 2.0 * height(x);
  }
};

/// Best of `runs` times of f, in seconds.
template <class F>
double best_of(int runs, F&& f) {
  double best = 1e300;
  for (int k = 0; k < runs; ++k) {
    const double start = cpu_seconds();
    f();
    best = std::min(best, cpu_seconds() - start);
  }
  return best;
}

double pair_seconds(std::ptrdiff_t cells) {
  const auto lattice = Lattice<3>::periodic_box(Box<3>::cube(), cells);
  const PeriodicTransform<3> transform(lattice);
  AlignedVector<double> x(lattice.size(), 1.0);
  AlignedVector<PeriodicTransform<3>::Complex> z(transform.size());
  return best_of(5, [&] {
    transform.forward(x.data(), z.data());
    transform.backward(z.data(), x.data());
  });
}

template <int D>
struct Scene {
  Lattice<D> lattice;
  Ball<D> ball;
  LevelSet<ClosestPoint, D> level_set;
  Field<double, D> f;

  Scene(const Lattice<D>& nodes, const Ball<D>& shape)
      : lattice(nodes), ball(shape), level_set(nodes, shape, {}, OpenMP{1}), f(sample(nodes, Problem<D>::right_side)) {}

  template <class Solver>
  double value_error(const Solver& solver, const Field<double, D>& c) const {
    double error = 0.0;
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Index<D> node = lattice.node(i);
      if (solver.in_domain(node)) error = std::max(error, std::abs(c[i] - Problem<D>::value(lattice.position(node))));
    }
    return error;
  }
  double derivative_error(const Field<double, D, Sparse>& derivative, const Vec<D>& centre) const {
    const auto& band = level_set.band();
    const auto& points = level_set.method().points();
    double error = 0.0;
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      for (std::size_t i = 0; i < band.volume; ++i) {
        if (!points.found(b, i)) continue;
        const Vec<D> x = lattice.position(band.values().node(b, i)) + points.offset(b, i) * lattice.spacing();
        const double exact = dot(Problem<D>::gradient(x), x - centre) / norm(x - centre);
        error = std::max(error, std::abs(derivative.block(b)[i] - exact));
      }
    }
    return error;
  }
};

template <class Krylov, class S>
void run(const char* name, std::ptrdiff_t cells, int smoothings, double tolerance, nlohmann::json& table) {
  const Vec<3> centre = Vec<3>::constant(0.5);
  const double pair = pair_seconds(cells);
  Scene<3> scene(Lattice<3>::bounded_box(Box<3>::cube(), cells), Ball<3>(centre, 0.35));
  const Scene<3> later(scene.lattice, Ball<3>(centre, 0.35 + 0.1 * scene.lattice.spacing()));
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
    report = solver.solve(scene.f, Problem<3>::value, c);
  });
  Field<double, 3, Sparse> derivative(scene.lattice);
  const auto& points = scene.level_set.method().points();
  const double gradient = best_of(2, [&] { solver.normal_derivative(scene.level_set.band(), points, c, derivative); });
  const double value_error = scene.value_error(solver, c);
  const double derivative_error = scene.derivative_error(derivative, centre);
  // A step of growth: the interface moves by a tenth of a spacing, c is continued and serves as the guess.
  solver.continue_beyond(c, 2);
  const auto guess = c;
  solver.update(later.level_set.band());
  SolveReport warm;
  const double again = best_of(3, [&] {
    c = guess;
    warm = solver.solve(later.f, Problem<3>::value, c);
  });
  table.push_back({{"method", name},
                   {"cells", cells},
                   {"smoothings", smoothings},
                   {"tolerance", tolerance},
                   {"pair_seconds", pair},
                   {"setup_pairs", setup / pair},
                   {"solve_pairs", solve / pair},
                   {"warm_pairs", again / pair},
                   {"derivative_pairs", gradient / pair},
                   {"iterations", report.iterations},
                   {"warm_iterations", warm.iterations},
                   {"value_error", value_error},
                   {"derivative_error", derivative_error}});
  std::printf(
      "%-22s %4td cells  V(%d,%d)  tol %.0e  pair %.4f s  setup %5.2f  solve %5.2f (%d)  warm %5.2f (%d)  "
      "dc/dn %5.2f  errors %.2e %.2e\n",
      name, cells, smoothings, smoothings, tolerance, pair, setup / pair, solve / pair, report.iterations, again / pair,
      warm.iterations, gradient / pair, value_error, derivative_error);
  std::fflush(stdout);
}

/// Errors for random shifts of the lattice against the shape.
void run_shifts(int shifts, std::ptrdiff_t cells, nlohmann::json& result) {
  std::mt19937 random(5);
  std::vector<double> values, derivatives;
  for (int k = 0; k < shifts; ++k) {
    Vec<2> centre;
    for (int d = 0; d < 2; ++d) {
      centre[d] = 0.5 + std::uniform_real_distribution<>(0.0, 1.0)(random) / static_cast<double>(cells);
    }
    Scene<2> scene(Lattice<2>::bounded_box(Box<2>::cube(), cells), Ball<2>(centre, 0.31));
    Dirichlet<2> solver(scene.level_set.band(), {}, OpenMP{1});
    Field<double, 2> c(scene.lattice);
    solver.solve(scene.f, Problem<2>::value, c);
    Field<double, 2, Sparse> derivative(scene.lattice);
    solver.normal_derivative(scene.level_set.band(), scene.level_set.method().points(), c, derivative);
    values.push_back(scene.value_error(solver, c));
    derivatives.push_back(scene.derivative_error(derivative, centre));
  }
  for (auto* errors : {&values, &derivatives}) {
    std::ranges::sort(*errors);
    const double median = (*errors)[errors->size() / 2];
    const char* name = errors == &values ? "value" : "derivative";
    result[name] = {{"median", median}, {"worst", errors->back()}, {"least", errors->front()}};
    std::printf("%d shifts, error of the %s: median %.3e, worst %.3e (%.2f of it)\n", shifts, name, median,
                errors->back(), errors->back() / median);
  }
  result["shifts"] = shifts;
}

/// `smoke`: one method, so that a test of the program compiles in seconds.
template <bool smoke>
void run_methods(const std::vector<std::ptrdiff_t>& resolutions, nlohmann::json& table) {
  for (const std::ptrdiff_t cells : resolutions) {
    run<BiCGStab, RedBlack>("BiCGStab, RedBlack", cells, 1, 1e-8, table);
    if constexpr (!smoke) {
      run<BiCGStab, RedBlack>("BiCGStab, RedBlack", cells, 2, 1e-8, table);
      run<BiCGStab, Chebyshev<2>>("BiCGStab, Chebyshev<2>", cells, 1, 1e-8, table);
      run<GMRES<12>, RedBlack>("GMRES<12>, RedBlack", cells, 1, 1e-8, table);
    }
  }
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  std::vector<std::ptrdiff_t> resolutions{32, 64, 128};
  int shifts = 1000;
  bool quick = false;
  std::string json;
  CLI::App app("Error against time of Dirichlet problems on an interface");
  app.add_option("--resolutions", resolutions, "cells along an axis");
  app.add_option("--shifts", shifts, "random shifts of the lattice in 2D");
  app.add_option("--json", json, "write the results to this file");
  app.add_flag("--quick", quick, "coarse lattices and few shifts, to see that it runs");
  CLI11_PARSE(app, argc, argv);
  if (quick) {
    resolutions = {24};
    shifts = 5;
  }
  nlohmann::json table = nlohmann::json::array();
  bench::run_methods<BENCH_SMOKE != 0>(resolutions, table);
  nlohmann::json cuts;
  if (shifts > 0) bench::run_shifts(shifts, 32, cuts);
  if (!json.empty()) std::ofstream(json) << nlohmann::json{{"runs", table}, {"cuts", cuts}}.dump(1) << '\n';
  return 0;
}
