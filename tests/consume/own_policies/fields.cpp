// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

// Policies of a user's own for bands, surfaces, multigrid and loops: each is found to do what it declares.
#include <cmath>
#include <numbers>

#include <cambium/cambium.hpp>
#include <cambium/multigrid/multigrid.hpp>

#include "check.hpp"
#include "delta_function.hpp"
#include "execution.hpp"
#include "extension.hpp"
#include "geometry.hpp"
#include "kick_off.hpp"
#include "smoother.hpp"
#include "state.hpp"
#include "surface_motion.hpp"
#include "surface_stencil.hpp"

using namespace cambium;

namespace {

const Ball<2> unit_disc({0.01, 0.02}, 1.0);

Lattice<2> lattice() { return Lattice<2>::bounded_box(Box<2>{{-1.6, -1.6}, {1.6, 1.6}}, 48); }

/// A spring of delta functions keeps forces, a sum keeps its value, pendulums come back after a turn.
void numbers(Checks& check) {
  Particles<2> particles(1);
  const auto force = particles.add<double>("force");
  particles.positions().set(0, {0.1, 0.2});
  particles[force][0] = 3.0;
  Field<double, 2> mesh(lattice());
  p2m<QuadraticSpline>(particles, force, mesh);
  const auto number = [](std::size_t i) { return static_cast<double>(i); };
  check("force on the nodes",
        reduce(
            HalfOfThem{}, mesh.size(), 0.0, [&](std::size_t i) { return mesh[i]; }, std::plus<>()),
        3.0, 1e-14);
  check("sum by half of the threads", reduce(HalfOfThem{}, 5000, 0.0, number, std::plus<>()), 4999.0 * 2500.0, 0.0);

  Pendulums swing{{1.0}, {0.0}};
  RK4<Pendulums> stepper(swing);
  for (int s = 0; s < 100; ++s) {
    stepper.step(swing, 0.0, 0.02 * std::numbers::pi, [](const Pendulums& y, double, Pendulums& rate) {
      rate.angle = y.rate;
      rate.rate[0] = -y.angle[0];
    });
  }
  check("pendulum after a turn", swing.angle[0], 1.0, 1e-6);
}

void bands(Checks& check) {
  const LevelSet<ClosestPoint, 2> disc(lattice(), unit_disc);
  BandGeometry<double, 2> geometry(lattice());
  Inwards::Method<double, 2>()(disc.band(), geometry, Serial{});
  const Index<2> right{39, 24};  // x = 1, y = 0
  check("normal inwards", geometry.normal(right)[0], -1.0, 1e-3);
  check("curvature of that", geometry.mean(right), -1.0 / norm(Vec<2>{0.99, -0.02}), 5e-3);

  const LevelSet<FastMarching<AlongAxes>, 2> marched(lattice(), [](const Vec<2>& x) { return 3.0 * unit_disc(x); });
  check("phi from AlongAxes", marched.band()(Index<2>{42, 24}), norm(Vec<2>{1.19, -0.02}) - 1.0, 5e-3);

  Field<double, 2, Sparse> x(lattice()), extended(lattice());
  take_blocks(x, disc.band());
  for_each_node(x, [&](const Index<2>& node, double& value) { value = lattice().position(node)[0]; });
  ByNearestNode::Method<double, 2>({})(disc.band(), x, extended, Serial{});
  check("x extended by ByNearestNode", extended(Index<2>{42, 24}), 1.01, lattice().spacing());
}

/// No reaction.
struct Inert {
  static constexpr int species = 1;
  Vec<1> operator()(const Vec<1>&) const { return {0.0}; }
};

/// cos 2 theta decays at 4 D, on a disc that the wind carries.
void surfaces(Checks& check) {
  SurfacePattern<Inert, Wind<2>, StabilisedSteps, Isotropic, 2> pattern({lattice(), unit_disc}, Inert{}, Vec<1>{0.5},
                                                                        Wind<2>{{0.5, 0.0}});
  const auto mode = [](const Vec<2>& y) { return Vec<1>{std::cos(2.0 * std::atan2(y[1] - 0.02, y[0] - 0.01))}; };
  pattern.sample(mode);
  pattern.advance(0.2);
  double worst = 0.0;
  for (std::size_t k = 0; k < pattern.band().size(); ++k) {
    const double exact = std::exp(-0.4) * mode(pattern.band().point(k) - Vec<2>{0.1, 0.0})[0];
    worst = std::max(worst, std::abs(pattern.concentration(0)[k] - exact));
  }
  check("error of the carried mode", worst, 0.0, 3e-3);
  check("middle of the disc", measures(pattern.surface().band()).centroid[0], 0.11, 1e-4);
}

/// Multigrid with a smoother of one's own solves the discrete equations all the same.
void grids(Checks& check) {
  const auto box = Lattice<2>::bounded_box(Box<2>::cube(), 32);
  const auto f = sample(
      box, [](const Vec<2>& x) { return std::sin(std::numbers::pi * x[0]) * std::sin(std::numbers::pi * x[1]); });
  Field<double, 2> u(box);
  Multigrid<2, Jacobi>(box).solve(f, u);
  const double eigenvalue = 8.0 * 32.0 * 32.0 * std::pow(std::sin(std::numbers::pi / 64.0), 2);
  check("solution by Jacobi", u(Index<2>{16, 16}), 1.0 / eigenvalue, 1e-8);
}

}  // namespace

int main() {
  Checks check;
  check_delta_function<QuadraticSpline>();
  check_geometry_policy<Inwards>();
  check_kick_off<AlongAxes>();
  check_surface_stencil<Isotropic>();
  check_smoother<Jacobi>();
  static_assert(Execution<HalfOfThem>);
  numbers(check);
  bands(check);
  surfaces(check);
  grids(check);
  return check.failures;
}
