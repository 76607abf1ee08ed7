// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

// Policies of a user's own for tumours, one of each kind: together they are a tumour whose growth is known.
#include <cmath>
#include <numbers>

#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/models/tumour.hpp>

#include "check.hpp"
#include "filter.hpp"
#include "motion.hpp"
#include "necrosis.hpp"
#include "nutrient.hpp"
#include "outside.hpp"
#include "reinitialisation.hpp"
#include "stepping.hpp"

namespace {

using namespace cambium;

/// Radius at t = 0.1 of a disc of radius 2 whose speed is the least of G (1 - A) R / 2 and 4.
double radius(double growth) {
  using Own =
      Tumour<2, WellFed, EvenGrowth, Resting, SpeedLimit<4>, ForwardEuler, ByParticles, ReinitialiseBy<Rescaled>>;
  const auto lattice = Lattice<2>::bounded_box(Box<2>{{-4.5, -4.5}, {4.5, 4.5}}, 36);
  Own tumour(lattice, Ball<2>({0.02, 0.05}, 2.0), {.parameters = {.growth = growth}});
  while (0.1 - tumour.time() > 1e-12) tumour.step(0.1 - tumour.time());
  return std::sqrt(measures(tumour.level_set().band()).volume / std::numbers::pi);
}

}  // namespace

int main() {
  Checks check;
  check("radius of the fed disc", radius(4.0), 2.0 * std::exp(0.1), 4e-3);  // Euler's error: R t dt / 2 = 3e-3
  check("radius at the limit", radius(40.0), 2.4, 2e-3);
  return check.failures;
}
