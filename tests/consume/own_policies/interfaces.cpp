// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

// Policies of a user's own for level sets, conditions on interfaces and models: each is found to do what it declares.
#include <cmath>

#include <cambium/interface/jump.hpp>
#include <cambium/levelset.hpp>
#include <cambium/poisson/box.hpp>

#include "check.hpp"
#include "extension.hpp"
#include "jump_rule.hpp"
#include "necrosis.hpp"
#include "reinitialisation.hpp"
#include "shape.hpp"
#include "surface_motion.hpp"

using namespace cambium;

namespace {

/// p = 0.3 + x inside a disc and 0 outside: the jump is linear, so that LinearJump continues it exactly.
double inside_of_jump() {
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 40);
  const Vec<2> middle{0.5, 0.47};
  const LevelSet<ClosestPoint, 2> disc(lattice, Ball<2>(middle, 0.3));
  BasicJump<2, double, LinearJump> jump(lattice);
  jump.attach(disc.band());
  jump.set([](const Vec<2>& x) { return -(0.3 + x[0]); },
           [&](const Vec<2>& x) { return -(x[0] - middle[0]) / norm(x - middle); });
  Field<double, 2> f(lattice), p(lattice);
  jump.correct(f);
  BoxPoisson<2>(lattice, {Boundary::dirichlet, Boundary::dirichlet}).solve(f, p);
  return p(Index<2>{28, 16});
}

}  // namespace

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

  check("p where x is 0.7", inside_of_jump(), 1.0, 1e-4);

  const auto plane = Lattice<2>::bounded_box(Box<2>::cube(), 8);
  const Field<double, 2> nutrient(plane, 0.9);
  const NarrowBand<double, 2> band(plane, 3.0 * plane.spacing());
  check("growth where fed", Resting::source({.necrotic_limit = 0.5}, nutrient, band, 0), 20.0 * (0.9 - 0.5), 1e-12);
  check("growth where starved", Resting::source({.necrotic_limit = 0.95}, nutrient, band, 0), 0.0, 0.0);
  return check.failures;
}
