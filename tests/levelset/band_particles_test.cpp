// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE levelset_band_particles
#include <boost/test/unit_test.hpp>
#include <limits>
#include <tuple>
#include <vector>

#include <cambium/levelset/advection/band_particles.hpp>
#include <cambium/levelset/advection/cutoff.hpp>
#include <cambium/levelset/advection/mover.hpp>
#include <cambium/time/rk4.hpp>

#include "levelset/advection_scenes.hpp"

using namespace cambium;
using namespace advection_scenes;

using Dimensions = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

BOOST_AUTO_TEST_CASE(cutoff_joins_one_and_zero_smoothly) {
  const Cutoff<double> chi{2.0, 5.0};
  BOOST_TEST(chi(1.9) == 1.0);
  BOOST_TEST(chi(-2.0) == 1.0);
  BOOST_TEST(chi(5.0) == 0.0);
  BOOST_TEST(chi(-7.0) == 0.0);
  BOOST_TEST(chi(3.5) == 0.5,
             boost::test_tools::tolerance(1e-15));  // a cubic with equal slopes is odd about its middle
  BOOST_TEST(chi(-3.0) == 20.0 / 27.0, boost::test_tools::tolerance(1e-15));
  // Continuous slope: what the differences of a cubic of third derivative 12 / width^3 leave at the joints.
  BOOST_TEST(std::abs(chi(2.0 + 1e-5) - 1.0) < 1e-10);
  BOOST_TEST(std::abs(chi(5.0 - 1e-5)) < 1e-10);
  const Cutoff<double> none{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  BOOST_TEST(none(1e30) == 1.0);
}

// Particles of a band moved by chi u: those within `inner` go all the way, those beyond `outer` stay to the last bit.
BOOST_AUTO_TEST_CASE_TEMPLATE(particles_beyond_the_cutoff_do_not_move, Dim, Dimensions) {
  constexpr int D = Dim::value;
  const auto lattice = Lattice<D>::periodic_box(Box<D>::cube(), 32);
  const LevelSet<ClosestPoint, D, double> ball(lattice, Ball<D>{}, {}, Serial{});
  const double h = lattice.spacing();
  detail::BandParticles<double, D> particles;
  particles.take(ball.band(), 4, Serial{});
  const Columns<D, double> x = particles.positions();
  std::vector<Vec<D>> start;
  for (std::size_t p = 0; p < x.size(); ++p) start.push_back(x[p]);
  const Cutoff<double> cutoff{2.0 * h, 4.0 * h};
  const auto phi = particles.phi().column(0);
  const Vec<D> u = Vec<D>::constant(1.0);
  const double dt = 0.3 * h;
  detail::Mover<double, D, RK4> move;
  move(
      x, [&](std::size_t p) { return cutoff(phi[p]); }, [&](const Vec<D>&, double) { return u; }, 0.0, dt, 3, Serial{});
  std::size_t all = 0, part = 0, none = 0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    const Vec<D> moved = x[p] - start[p];
    const double distance = std::abs(phi[p]);
    ++(distance >= 4.0 * h ? none : distance <= 2.0 * h ? all : part);
    if (distance >= 4.0 * h) BOOST_REQUIRE((x[p] == start[p]));
    BOOST_REQUIRE(norm(moved - dt * cutoff(phi[p]) * u) <= 1e-15);
  }
  BOOST_TEST(all > 100u);
  BOOST_TEST(part > 100u);
  BOOST_TEST(none > 100u);
  // Over the two spacings of the cut-off the factor falls by at most 3/4 a spacing of distance.
  const double distortion = particles.distortion(ball.band(), Serial{});
  BOOST_TEST(distortion <= 0.75 * 0.3 * std::sqrt(static_cast<double>(D)));
  BOOST_TEST(distortion > 0.15);
}
