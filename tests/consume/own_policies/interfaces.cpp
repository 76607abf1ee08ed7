// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

// Policies of a user's own for level sets, conditions on interfaces and models: each is found to do what it declares.
#include <cmath>

#include <cambium/levelset.hpp>

#include "check.hpp"
#include "extension.hpp"
#include "jump_rule.hpp"
#include "necrosis.hpp"
#include "reinitialisation.hpp"
#include "shape.hpp"
#include "surface_motion.hpp"

using namespace cambium;

int main() {
  Checks check;
  check_shape<Diamond<3>>();
  check_extension<ByNearestNode>();
  check_jump_rule<LinearJump>();
  check_surface_motion<Wind<3>>();

  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 64);
  // Corners are rounded by less than a spacing: 4 corners of (h/2)^2 each at most.
  const LevelSet<Rescaled, 2> diamond(lattice, Diamond<2>({0.5, 0.5}, 0.3));
  check("area of the diamond", measures(diamond.band()).volume, 2.0 * 0.3 * 0.3, 4.0 * 0.25 / (64.0 * 64.0));

  const Ball<2> ball({0.5, 0.5}, 0.3);
  LevelSet<Rescaled, 2> tripled(lattice, [&](const Vec<2>& x) { return 3.0 * ball(x); });
  tripled.reinitialise();
  // Differences of the distance along an axis are 1 but for the curvature: h / (2 R).
  check("phi at the centre's side", tripled.band()(Index<2>{14, 32}), -(0.3 - (0.5 - 14.0 / 64.0)), 1e-3);

  const auto plane = Lattice<2>::bounded_box(Box<2>::cube(), 8);
  const Field<double, 2> nutrient(plane, 0.9);
  const NarrowBand<double, 2> band(plane, 3.0 * plane.spacing());
  check("growth where fed", Resting::source({.necrotic_limit = 0.5}, nutrient, band, 0), 20.0 * (0.9 - 0.5), 1e-12);
  check("growth where starved", Resting::source({.necrotic_limit = 0.95}, nutrient, band, 0), 0.0, 0.0);
  return check.failures;
}
