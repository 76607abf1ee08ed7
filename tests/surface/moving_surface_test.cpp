// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE moving_surface
#include <boost/test/unit_test.hpp>
#include <cmath>

#include <cambium/levelset/measures.hpp>

#include "support/surface/carrier.hpp"

using namespace motion;

namespace {

BOOST_AUTO_TEST_CASE(growing_sphere_keeps_its_mass) {
  const Outcome outcome = growing_sphere<2, 3>(40, 4);
  BOOST_TEST_MESSAGE("error " << outcome.error << ", mass " << outcome.mass);
  BOOST_TEST(outcome.error < 1e-3);
  BOOST_TEST(outcome.mass < 2e-5);
}

/// Diffusion on a sphere that turns and travels across the lattice, against the sphere at rest.
BOOST_AUTO_TEST_CASE(a_moving_sphere_is_as_good_as_one_at_rest) {
  constexpr double end = 0.1;
  constexpr int steps = 4;
  const Vec<3> centre = modes::centre<3>(), travel{0.9, -0.6, 0.3};
  const auto run = [&](double speed) {
    const auto lattice = Lattice<3>::bounded_box({Vec<3>::constant(-1.9), Vec<3>::constant(1.9)}, 32);
    Carrier<2, 3> carrier{LevelSet<>(lattice, Ball<3>(centre, 1.0))};
    carrier.band.sample([&](const Vec<3>& x) { return modes::harmonic<3>(3, x - centre); }, carrier.c);
    for (int s = 0; s < steps; ++s) {
      carrier.diffuse(0.5 * end / steps);
      carrier.move(
          [&](const Vec<3>& x, double t) {
            const Vec<3> r = x - centre - speed * t * travel;  // turning about the third axis
            return speed * (travel + 3.0 * Vec<3>{-r[1], r[0], 0.0});
          },
          end / steps);
      carrier.diffuse(0.5 * end / steps);
    }
    return carrier.error([&](const Vec<3>& x) {
      const Vec<3> r = x - centre - speed * end * travel;
      const double angle = 3.0 * speed * end;
      const Vec<3> turned_back{std::cos(angle) * r[0] + std::sin(angle) * r[1],
                               std::cos(angle) * r[1] - std::sin(angle) * r[0], r[2]};
      return std::exp(-12.0 * end) * modes::harmonic<3>(3, turned_back);
    });
  };
  const double at_rest = run(0.0), moving = run(1.0);
  BOOST_TEST_MESSAGE("at rest " << at_rest << ", moving " << moving);
  BOOST_TEST(moving < 2.0 * at_rest);
}

/// A neck is squeezed until it breaks: values stay within their bounds, and what is left is reported.
BOOST_AUTO_TEST_CASE(the_pinch_of_a_dumbbell_is_survived) {
  const auto lattice = Lattice<3>::bounded_box({Vec<3>::constant(-1.0), Vec<3>::constant(1.0)}, 32);
  const auto neck = [](const Vec<3>& x) {
    return std::min({norm(x - Vec<3>{-0.42, 0.03, 0.03}) - 0.3, norm(x - Vec<3>{0.42, 0.03, 0.03}) - 0.3,
                     std::max(std::hypot(x[1] - 0.03, x[2] - 0.03) - 0.14, std::abs(x[0]) - 0.4)});
  };
  Carrier<2, 3> carrier(LevelSet<>(lattice, neck), false);
  carrier.band.sample([](const Vec<3>& x) { return x[0] < 0.0 ? -1.0 : 1.0; }, carrier.c);
  BOOST_TEST(measures(carrier.level_set.band()).interface_components == 1U);
  for (int s = 0; s < 12; ++s) {
    carrier.move(
        [](const Vec<3>& x, double) {
          return -3.0 * std::exp(-40.0 * x[0] * x[0]) * Vec<3>{0.0, x[1] - 0.03, x[2] - 0.03};
        },
        0.05);
  }
  BOOST_TEST(measures(carrier.level_set.band()).interface_components == 2U);
  for (const double value : carrier.c) BOOST_TEST(std::abs(value) < 1.6);
}

}  // namespace
