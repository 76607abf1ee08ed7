// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE levelset_lagrangian_turns
#include <boost/test/unit_test.hpp>
#include <tuple>

#include "levelset/shift_error.hpp"
#include "support/order.hpp"

using namespace cambium;
using namespace advection_scenes;

using Dimensions = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

// The sums of weights cancel in a constant: the band's far values, and a plane moved by a shift.
BOOST_AUTO_TEST_CASE_TEMPLATE(planes_stay_planes_under_shifts, Dim, Dimensions) {
  constexpr int D = Dim::value;
  const auto lattice = Lattice<D>::periodic_box(Box<D>::cube(), 48);
  // A slab: two planes, 24 spacings apart, so that bands do not touch.
  const auto slab = [](const Vec<D>& x) { return std::abs(x[0] - 0.5) - 0.25; };
  LevelSet<ClosestPoint, D, double> level_set(lattice, slab, {}, Serial{});
  Lagrangian<> advection({.reinitialise_every = 1000});
  Vec<D> u = Vec<D>::constant(0.3);
  u[0] = 0.137;
  advection.step(
      level_set, [&](const Vec<D>&, double) { return u; }, 0.0, 1.0, Serial{});
  const double h = lattice.spacing();
  std::size_t linear = 0;
  for_each_band_node(level_set.band(), [&](const Index<D>& node, double phi) {
    Vec<D> x = lattice.position(node);
    x[0] -= 0.137;
    const double exact = slab(lattice.domain().wrap(x));
    if (std::abs(exact) > 2.5 * h) return;  // nodes whose stencils reach the constant part of phi
    ++linear;
    BOOST_REQUIRE(std::abs(phi - exact) <= 1e-14);
  });
  BOOST_TEST(linear > 100u);
  std::size_t far = 0;
  for (std::size_t b = 0; b < level_set.band().blocks(); ++b) {
    for (const double phi : level_set.band().values().block(b)) {
      far += std::abs(phi) == level_set.band().half_width() ? 1u : 0u;
    }
  }
  BOOST_TEST(far > 100u);
}

// A turn of a ball about the middle of the box, remeshed as the distortion asks.
BOOST_AUTO_TEST_CASE_TEMPLATE(rotations_bring_a_ball_back, Dim, Dimensions) {
  constexpr int D = Dim::value;
  const auto turned = [](std::ptrdiff_t n) {
    const auto lattice = Lattice<D>::bounded_box(Box<D>::cube(), n);
    Ball<D> ball;
    ball.centre[0] = 0.64;
    ball.radius = 0.13;
    LevelSet<ClosestPoint, D, double> level_set(lattice, ball, {}, Serial{});
    Lagrangian<> advection({.largest_distortion = 0.3});
    const double before = enclosed(level_set);
    std::size_t remeshings = 0;
    for (int k = 0; k < 4; ++k) {
      const auto report = advection.step(level_set, Rotation<D>{}, 0.25 * k, 0.25, Serial{});
      remeshings += report.remeshings;
      BOOST_TEST(report.distortion <= 0.3);
    }
    // Neighbours are moved apart by 2 sin(angle / 2): at least 21 parts. A quarter turn moves them apart by less than
    // its arc, so that its first cut, in 5, is too few, and each part is cut in 2.
    BOOST_TEST(remeshings == 40u);
    // Volume drifts by no more than the interface does.
    const double error = interface_error(level_set, ball);
    BOOST_TEST(std::abs(enclosed(level_set) / before - 1.0) <= D * error / ball.radius + 1e-12);
    return error;
  };
  const std::ptrdiff_t n = D == 2 ? 64 : 32;
  const double coarse = turned(n), fine = turned(2 * n);
  BOOST_TEST_MESSAGE(D << "D turn " << coarse * double(n) << " h " << fine * double(2 * n) << " h");
  // Lattices turned against each other do not have the kernel's moments: first order at a fixed number of remeshings.
  BOOST_TEST(fine * static_cast<double>(2 * n) <= 0.02);
  BOOST_TEST(support::observed_order(coarse, fine) >= 0.7);
}

// Measured 4.6: the closest points that follow each shift are of order 5 as well.
BOOST_AUTO_TEST_CASE(shifts_in_three_dimensions) {
  const double coarse = shift_error<M6, 3>(32), fine = shift_error<M6, 3>(64);
  BOOST_TEST_MESSAGE("3D " << coarse << " " << fine);
  BOOST_TEST(support::observed_order(coarse, fine) >= 4.0);
}
