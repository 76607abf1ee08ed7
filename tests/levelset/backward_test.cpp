// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE backward
#include <boost/test/unit_test.hpp>
#include <numbers>
#include <tuple>

#include <cambium/levelset.hpp>
#include <cambium/time.hpp>

#include "levelset_scenes.hpp"
#include "support/order.hpp"

using namespace cambium;
using scenes::distance_error;
using scenes::Sphere;

namespace {

template <int D>
using Dimension = std::integral_constant<int, D>;
using Dimensions = std::tuple<Dimension<2>, Dimension<3>>;

/// Turns once around the axis of the box in unit time.
template <int D>
Vec<D> turning(const Vec<D>& x, double) {
  constexpr double rate = 2.0 * std::numbers::pi;
  Vec<D> u{};
  u[0] = -rate * (x[1] - 0.5);
  u[1] = rate * (x[0] - 0.5);
  return u;
}

template <int D>
Sphere<D> sphere() {
  Sphere<D> sphere;
  sphere.centre[0] = 0.4;
  sphere.radius = 0.18;
  return sphere;
}

template <int D>
Lattice<D> lattice(std::ptrdiff_t cells) {
  return Lattice<D>::bounded_box(Box<D>::cube(), cells);
}

}  // namespace

// One turn in ten steps. Paths are followed finely enough (64 parts of fourth order); the interpolations remain: h^5
// each.
BOOST_AUTO_TEST_CASE_TEMPLATE(turning_has_the_order_of_the_kernel, I, Dimensions) {
  constexpr int D = I::value;
  double coarse = 0.0;
  for (const std::ptrdiff_t cells : {32, 64}) {
    LevelSet<ClosestPoint, D> level_set(lattice<D>(cells), sphere<D>());
    Backward<> advection({.substeps = D == 2 ? 32 : 16});
    for (int s = 0; s < 10; ++s) advection.step(level_set, turning<D>, 0.1 * s, 0.1);
    const double error = distance_error(level_set.band(), sphere<D>(), 2.0) / static_cast<double>(cells);
    BOOST_TEST_MESSAGE(cells << " cells: " << error);
    if (coarse > 0.0) BOOST_TEST(support::observed_order(coarse, error) > 4.0);
    coarse = error;
  }
}

// The flow turns back at half time: its speed depends on time, and the error of the paths is that of the stepper.
template <template <class, class> class Stepper>
double error_of_paths(int steps) {
  LevelSet<ClosestPoint, 2> level_set(lattice<2>(128), sphere<2>());
  Backward<Lambda<6, 4>, Stepper> advection({.substeps = 1});
  const double dt = 1.0 / steps;
  const auto flow = [](const Vec<2>& x, double t) { return 0.6 * (1.0 - t * t) * turning<2>(x, t); };
  for (int s = 0; s < steps; ++s) advection.step(level_set, flow, s * dt, dt);
  const double angle = 0.6 * 2.0 * std::numbers::pi * (1.0 - 1.0 / 3.0);
  Sphere<2> exact = sphere<2>();
  exact.centre[0] = 0.5 - 0.1 * std::cos(angle);
  exact.centre[1] = 0.5 - 0.1 * std::sin(angle);
  return distance_error(level_set.band(), exact, 1.5);
}

BOOST_AUTO_TEST_CASE(unsteady_flow_has_the_order_of_the_stepper_in_time) {
  BOOST_TEST(support::observed_order(error_of_paths<RK4>(4), error_of_paths<RK4>(8)) > 3.5);
  BOOST_TEST(support::observed_order(error_of_paths<TVDRK3>(5), error_of_paths<TVDRK3>(10)) > 2.6);
}

// A quarter of a turn a step: as many substeps as the error asks for, whatever the stepper.
BOOST_AUTO_TEST_CASE(paths_are_as_exact_as_asked) {
  const auto error = [](auto advection, double allowed) {
    LevelSet<ClosestPoint, 2> level_set(lattice<2>(128), sphere<2>());
    const AdvectionReport report = advection.step(level_set, turning<2>, 0.0, 0.25);
    Sphere<2> exact = sphere<2>();
    exact.centre = {0.5, 0.4};
    const double found = distance_error(level_set.band(), exact, 1.5);
    BOOST_TEST_MESSAGE(report.substeps << " substeps, error " << found << " spacings");
    BOOST_TEST(found < 2.0 * allowed);  // an estimate, of what two runs differ by
    return report.substeps;
  };
  const int loose = error(Backward<>({.path_error = 0.1}), 0.1);
  const int strict = error(Backward<>({.path_error = 1e-4}), 1e-4);
  // A thousand times the accuracy: by fourth order 5.6 times the substeps, and these are powers of 2.
  BOOST_TEST(strict >= 4 * loose);
  BOOST_TEST(strict <= 8 * loose);
  error(Backward<Lambda<4, 4>, TVDRK2>({.path_error = 0.01}), 0.01);
}

BOOST_AUTO_TEST_CASE(paths_that_cannot_be_followed_are_an_error) {
  LevelSet<ClosestPoint, 2> level_set(lattice<2>(32), sphere<2>());
  const auto jerky = [](const Vec<2>& x, double t) { return Vec<2>{std::sin(1e6 * (x[0] + x[1] + t)), 0.0}; };
  BOOST_CHECK_THROW(Backward<>().step(level_set, jerky, 0.0, 0.1), ValueError);
}

// Whole spacings: particles come from nodes, where the kernel interpolates.
BOOST_AUTO_TEST_CASE(a_shift_by_whole_spacings_is_exact) {
  const auto lattice = Lattice<2>::periodic_box(Box<2>::cube(), 64);
  LevelSet<ClosestPoint, 2> level_set(lattice, sphere<2>());
  Backward<> advection;
  const auto shift = [](const Vec<2>&, double) { return Vec<2>{0.25, 0.125}; };
  for (int s = 0; s < 4; ++s) advection.step(level_set, shift, 0.5 * s, 0.5);
  const auto wrapped = [](Vec<2> x) {
    x[1] -= 0.25;  // two units of time: half a period and a quarter
    x[0] -= 0.5;
    for (int d = 0; d < 2; ++d) x[d] -= std::floor(x[d] - sphere<2>().centre[d] + 0.5);
    return sphere<2>()(x);
  };
  BOOST_TEST(distance_error(level_set.band(), wrapped, 2.0) < 1e-12);
}

BOOST_AUTO_TEST_CASE(threads_do_not_change_a_bit) {
  const auto run = [](const auto& execution) {
    LevelSet<ClosestPoint, 3> level_set(lattice<3>(32), sphere<3>(), {}, execution);
    Backward<> advection;
    for (int s = 0; s < 2; ++s) advection.step(level_set, turning<3>, 0.05 * s, 0.05, execution);
    std::vector<double> values;
    for (std::size_t b = 0; b < level_set.band().blocks(); ++b) {
      for (const double phi : level_set.band().values().block(b)) values.push_back(phi);
    }
    return values;
  };
  const auto one = run(Serial{});
  BOOST_TEST((one == run(OpenMP{2})));
  BOOST_TEST((one == run(OpenMP{3})));
}

BOOST_AUTO_TEST_CASE(what_cannot_be_advanced_is_left_as_it_was) {
  LevelSet<ClosestPoint, 2> level_set(lattice<2>(32), sphere<2>());
  const auto before = level_set.band()({16, 16});
  Backward<> advection;
  const auto away = [](const Vec<2>&, double) { return Vec<2>{1.0, 0.0}; };
  const auto nowhere = [](const Vec<2>&, double) { return Vec<2>{std::nan(""), 0.0}; };
  BOOST_CHECK_THROW(advection.step(level_set, away, 0.0, 0.38), InterfaceError);
  BOOST_CHECK_THROW(advection.step(level_set, away, 0.0, 3.0), Error);
  BOOST_CHECK_THROW(advection.step(level_set, nowhere, 0.0, 0.1), Error);
  BOOST_CHECK_THROW(advection.step(level_set, away, 0.0, -1.0), ValueError);
  BOOST_CHECK_THROW(Backward<>({.substeps = -1}), ValueError);
  BOOST_CHECK_THROW(Backward<>({.path_error = 0.0}), ValueError);
  BOOST_TEST(level_set.band()({16, 16}) == before);
}

// The blocks of the band are cut to size after every call: the points of its nodes go with them.
BOOST_AUTO_TEST_CASE_TEMPLATE(closest_points_are_those_of_the_band, T, decltype(std::tuple<float, double>())) {
  const auto lattice = Lattice<3>::bounded_box(Box<3>::cube(), 48);
  const Vec<3> centre{0.4, 0.45, 0.5};
  LevelSet<ClosestPoint, 3, T> level_set(lattice, Ball<3>(centre, 0.2));
  const Vec<3, T> velocity{T(1.0), T(0.5), T(-0.25)};
  const double dt = 5.3 * lattice.spacing();
  Backward<>().step(
      level_set, [&](const Vec<3, T>&, double) { return velocity; }, 0.0, dt);
  for (const bool reinitialised : {false, true}) {
    if (reinitialised) level_set.reinitialise();
    const auto& band = level_set.band();
    const auto& points = level_set.method().points();
    std::size_t nodes = 0;
    double furthest = 0.0;
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      for (std::size_t i = 0; i < band.volume; ++i) {
        if (!band.in_band(band.values().block(b)[i])) continue;
        BOOST_REQUIRE(points.found(b, i));
        Vec<3> point = lattice.position(band.values().node(b, i));
        for (int d = 0; d < 3; ++d) {
          point[d] += lattice.spacing() * points.offset(b, i)[d] - (centre[d] + dt * static_cast<double>(velocity[d]));
        }
        furthest = std::max(furthest, std::abs(norm(point) - 0.2));
        ++nodes;
      }
    }
    BOOST_TEST(nodes > 10000U);
    // A ball of ten spacings in radius: measured 4e-5 spacings.
    BOOST_TEST(furthest < 8e-5 * lattice.spacing());
  }
}
