// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE eulerian
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include <cambium/levelset/advection/eulerian.hpp>
#include <cambium/levelset/reinit/pde_reinit.hpp>

#include "levelset/scaled_ball.hpp"
#include "support/order.hpp"

using namespace cambium;

namespace {

template <int N>
using Dimension = std::integral_constant<int, N>;
using Dimensions = std::tuple<Dimension<2>, Dimension<3>>;

/// A solid rotation about the middle in the plane of the first two axes, one turn in a time of 1.
template <int D, class T>
Vec<D, T> rotation(const Vec<D, T>& x) {
  const T rate = static_cast<T>(2.0 * std::numbers::pi);
  Vec<D, T> u{};
  u[0] = -rate * x[1];
  u[1] = rate * x[0];
  return u;
}

template <int D>
auto ball_at(const Vec<D>& centre) {
  return [=](const Vec<D>& x) { return norm(x - centre) - 0.3; };
}
/// Where the ball that starts at `from` is after so many turns.
template <int D>
Vec<D> turned(Vec<D> from, double turns) {
  const double angle = 2.0 * std::numbers::pi * turns;
  const Vec<D> x = from;
  from[0] = std::cos(angle) * x[0] - std::sin(angle) * x[1];
  from[1] = std::sin(angle) * x[0] + std::cos(angle) * x[1];
  return from;
}

using Reinit = PdeReinit<>;

template <int D, class T = double>
LevelSet<Reinit, D, T> ball_set(int cells, const Vec<D>& centre) {
  typename LevelSet<Reinit, D, T>::Params params;
  params.reinit = {.iterations = 3, .subcell_fix = SubcellFix::high_order};
  return LevelSet<Reinit, D, T>(support::box_of_ball<D>(cells), ball_at<D>(centre), params, Serial{});
}

template <int D>
Vec<D> start() {
  return 0.3 * Vec<D>::unit(0);
}

/// Error next to the interface after an eighth of a turn in two steps.
template <class Scheme, int D, class T = double>
double rotation_error(int cells) {
  auto set = ball_set<D, T>(cells, start<D>());
  Eulerian<Scheme> eulerian({.rebuild_every = 2, .reinitialise_every = 4});
  for (int step = 0; step < 2; ++step) {
    eulerian.step(
        set, [](const Vec<D, T>& x, double) { return rotation(x); }, 0.0, 1.0 / 16.0, Serial{});
  }
  return support::distance_error(set.band(), 1.0, ball_at<D>(turned(start<D>(), 0.125)));
}

/// Error after a translation that starts, turns and stops: unsteady, so that it shows the order in time.
double translation_error(int cells) {
  auto set = ball_set<2>(cells, Vec<2>{-0.2, 0.0});
  const double pi = std::numbers::pi;
  const auto velocity = [=](const Vec<2>&, double t) {
    return Vec<2>{0.4 * pi * 0.5 * std::sin(pi * t), 0.2 * pi * std::cos(pi * t)};
  };
  Eulerian<> eulerian({.reinitialise_every = 4});
  for (int step = 0; step < 2; ++step) eulerian.step(set, velocity, 0.5 * step, 0.5, Serial{});
  return support::distance_error(set.band(), 1.0, ball_at<2>(Vec<2>{0.2, 0.0}));
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(rotation_converges, Dim, Dimensions) {
  constexpr int D = Dim::value;
  const int n = D == 2 ? 32 : 24;
  const double coarse = rotation_error<WENO5, D>(n);
  const double fine = rotation_error<WENO5, D>(2 * n);
  BOOST_TEST_MESSAGE("errors " << coarse << " " << fine << " order " << support::observed_order(coarse, fine));
  // TVD RK3 at a fixed CFL number: third order.
  BOOST_TEST(support::observed_order(coarse, fine) > 2.5);
  BOOST_TEST(fine < 0.02 * 2.0 / (2 * n));
}

BOOST_AUTO_TEST_CASE(schemes_of_lower_order_converge_at_it) {
  const double first = support::observed_order(rotation_error<Upwind1, 2>(32), rotation_error<Upwind1, 2>(64));
  const double third = support::observed_order(rotation_error<WENO3, 2>(32), rotation_error<WENO3, 2>(64));
  BOOST_TEST_MESSAGE("orders " << first << " " << third);
  BOOST_TEST(first > 0.8);
  BOOST_TEST(first < 1.5);
  BOOST_TEST(third > 2.0);
}

BOOST_AUTO_TEST_CASE(unsteady_translation_converges) {
  const double coarse = translation_error(32);
  const double fine = translation_error(64);
  BOOST_TEST_MESSAGE("errors " << coarse << " " << fine << " order " << support::observed_order(coarse, fine));
  BOOST_TEST(support::observed_order(coarse, fine) > 2.5);
}

BOOST_AUTO_TEST_CASE(single_precision) {
  BOOST_TEST(std::abs(rotation_error<WENO5, 2, float>(32) - rotation_error<WENO5, 2>(32)) < 1e-4);
}

BOOST_AUTO_TEST_CASE(as_many_substeps_as_the_cfl_number_asks) {
  auto set = ball_set<2>(32, Vec<2>{});
  const auto velocity = [](const Vec<2>&, double) { return Vec<2>{1.0, -0.5}; };
  // |u| + |v| = 1.5 on 1/16: 0.1 / (0.5 / 16 / 1.5) = 4.8.
  const EulerianReport report = Eulerian<>({.rebuild_every = 2}).step(set, velocity, 0.0, 0.1, Serial{});
  BOOST_TEST(report.substeps == 5u);
  BOOST_TEST(report.reinitialisations == 3u);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(same_bits_for_any_number_of_threads, Dim, Dimensions) {
  constexpr int D = Dim::value;
  const auto advance = [](const auto& execution) {
    auto set = ball_set<D>(32, start<D>());
    Eulerian<>().step(
        set, [](const Vec<D>& x, double) { return rotation(x); }, 0.0, 0.01, execution);
    return set.band();
  };
  const auto one = advance(OpenMP{1});
  for (const int threads : {2, 3}) BOOST_TEST(support::same_bits(one, advance(OpenMP{threads})));
}

BOOST_AUTO_TEST_CASE(bad_input_leaves_the_level_set_as_it_was) {
  BOOST_CHECK_THROW(Eulerian<>({.cfl = 0.0}), ValueError);
  BOOST_CHECK_THROW(Eulerian<>({.rebuild_every = 0}), ValueError);
  BOOST_CHECK_THROW(Eulerian<>({.reinitialise_every = -1}), ValueError);
  auto set = ball_set<2>(32, start<2>());
  const NarrowBand<double, 2> before = set.band();
  const auto still = [](const Vec<2>&, double) { return Vec<2>{}; };
  BOOST_CHECK_THROW(Eulerian<>().step(set, still, 0.0, -1.0, Serial{}), ValueError);
  BOOST_CHECK_THROW(Eulerian<>({.rebuild_every = 12}).step(set, still, 0.0, 1.0, Serial{}), ValueError);
  // Not finite from the middle of the step on.
  const auto breaks = [](const Vec<2>& x, double t) {
    return t > 0.05 ? Vec<2>{std::numeric_limits<double>::quiet_NaN(), 0.0} : rotation(x);
  };
  BOOST_CHECK_THROW(Eulerian<>().step(set, breaks, 0.0, 0.1, Serial{}), ValueError);
  BOOST_TEST(support::same_bits(set.band(), before));
  // A ball that shrinks to nothing.
  const auto inward = [](const Vec<2>& x, double) {
    return (-2.0 / std::max(norm(x - start<2>()), 0.05)) * (x - start<2>());
  };
  BOOST_CHECK_THROW(Eulerian<>().step(set, inward, 0.0, 1.0, Serial{}), InterfaceError);
  BOOST_TEST(support::same_bits(set.band(), before));
}
