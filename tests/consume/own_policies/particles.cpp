// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

// Policies of a user's own for particles, operators, time and kinetics: each is found to do what it declares.
#include <cmath>
#include <numbers>

#include <cambium/cambium.hpp>

#include "check.hpp"
#include "kinetics.hpp"
#include "pse_kernel.hpp"
#include "stepper.hpp"
#include "symbol.hpp"

namespace {

using namespace cambium;

/// -Lap u = f for u = sin x, by a symbol of fourth order: exact for waves up to (2 pi / 32)^4 / 240.
void symbol(Checks& check) {
  const auto lattice = Lattice<2>::periodic_box(Box<2>::cube(2.0 * std::numbers::pi), 32);
  const auto f = sample(lattice, [](const Vec<2>& x) { return std::sin(x[0]); });
  Field<double, 2> u(lattice);
  PeriodicPoisson<2, Compact>(lattice).solve(f, u);
  check("solution of Poisson", u[8], 1.0, 1e-5);
}

/// d/dt (cos t, sin t): after one turn in n steps the error of order two falls to a quarter with 2 n.
double error_of_turn(int steps) {
  std::vector<double> state{1.0, 0.0};
  Midpoint<std::vector<double>> stepper;
  for (int s = 0; s < steps; ++s) {
    stepper.step(state, 0.0, 2.0 * std::numbers::pi / steps, [](const auto& x, double, auto& rate) {
      rate[0] = -x[1];
      rate[1] = x[0];
    });
  }
  return std::hypot(state[0] - 1.0, state[1]);
}

}  // namespace

int main() {
  Checks check;
  check_mollifier<Normal>();
  check_pse_kernel<Normal>();
  check_kinetics<PreyAndPredators>();
  check_stepper<Midpoint<std::vector<double>>, std::vector<double>>();

  symbol(check);
  check("Normal at its centre", scaled_mollifier<Normal>(Vec<2>{}, 1.0), 0.5 / std::numbers::pi, 1e-14);
  check("order of the stepper", std::log2(error_of_turn(64) / error_of_turn(128)), 2.0, 0.1);
  const Vec<2> state = fixed_point(PreyAndPredators{}, Vec<2>{0.6, 0.9});
  check("prey at rest", state[0], 0.5, 1e-10);
  check("predators at rest", state[1], 1.0, 1e-10);
  return check.failures;
}
