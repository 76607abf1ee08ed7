// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/levelset/shapes/ball.hpp>

#include "dirichlet/scene.hpp"
#include "support/best_of.hpp"

namespace bench {

struct Growth {
  double update_seconds = 1e300;    ///< new domain and hierarchy
  double continue_seconds = 1e300;  ///< guesses beyond the interface, where the domain is to grow
  double solve_seconds = 1e300;
  int iterations = 0;
  double cold_seconds = 1e300;  ///< setup and solve from zero of the same step
  int cold_iterations = 0;
};

/// Steps of growth: lap c = s c in a ball whose radius grows by a quarter of a spacing a step, c = 1 on it, with R
/// sqrt(s) = 2 as a growing tumour has it. The guess is the solution before, or the line through the two before.
template <class Solver>
Growth run_growth(const Lattice<3>& lattice, typename Solver::Params params, bool two_steps) {
  const double h = lattice.spacing();
  params.shift = 2.0 * 2.0 / (0.35 * 0.35);
  const auto ball = [&](int step) {
    return LevelSet<ClosestPoint, 3>(lattice, Ball<3>(Vec<3>::constant(0.5), 0.35 + 0.25 * h * step), {}, OpenMP{1});
  };
  const auto one = [](const Vec<3>&) { return 1.0; };
  const Field<double, 3> f(lattice);
  Field<double, 3> c(lattice), before(lattice);
  auto level_set = ball(-2);
  Solver solver(level_set.band(), params, OpenMP{1});
  solver.solve(f, one, c);
  solver.continue_beyond(c, 2);
  Growth result;
  for (int step = -1; step <= 2; ++step) {
    level_set = ball(step);
    auto guess = c;
    if (two_steps && step > -1) {
      for (std::size_t i = 0; i < c.size(); ++i) guess[i] += c[i] - before[i];
    }
    before = c;
    c = guess;
    const double update = best_of(1, [&] { solver.update(level_set.band()); });
    const double solve = best_of(1, [&] { result.iterations = solver.solve(f, one, c).iterations; });
    const double beyond = best_of(1, [&] { solver.continue_beyond(c, 2); });
    if (step < 0) continue;
    result.update_seconds = std::min(result.update_seconds, update);
    result.solve_seconds = std::min(result.solve_seconds, solve);
    result.continue_seconds = std::min(result.continue_seconds, beyond);
  }
  Field<double, 3> cold(lattice);
  result.cold_seconds = best_of(2, [&] { solver.update(level_set.band()); }) + best_of(2, [&] {
                          cold.fill(0.0);
                          result.cold_iterations = solver.solve(f, one, cold).iterations;
                        });
  return result;
}

}  // namespace bench
