// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE allocations
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <support/count_allocations.hpp>
#include <tuple>
#include <type_traits>

#include <cambium/levelset/advection/backward.hpp>
#include <cambium/levelset/advection/eulerian.hpp>
#include <cambium/levelset/advection/lagrangian.hpp>

#include "levelset/advection_scenes.hpp"

namespace {

using namespace cambium;

template <int N>
using Dimension = std::integral_constant<int, N>;
using Dimensions = std::tuple<Dimension<2>, Dimension<3>>;

template <int D>
LevelSet<ClosestPoint, D> ball() {
  return {Lattice<D>::bounded_box(Box<D>::cube(), 40), advection_scenes::Ball<D>{}, {}, Serial{}};
}

/// Calls of operator new in f(n), n = 0, 1, ..., `count` - 1, after as many that fill buffers.
template <class F>
std::size_t taken_by(int count, F&& f) {
  for (int n = 0; n < count; ++n) f(n);
  const std::size_t before = support::allocations;
  for (int n = 0; n < count; ++n) f(n);
  return support::allocations - before;
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(reinitialisation, Dim, Dimensions) {
  auto level_set = ball<Dim::value>();
  BOOST_TEST(taken_by(3, [&](int) { level_set.reinitialise(Serial{}); }) == 0U);
}

// The ball goes to and fro, so that it comes back to blocks that it has been in.
BOOST_AUTO_TEST_CASE_TEMPLATE(backward_steps, Dim, Dimensions) {
  constexpr int D = Dim::value;
  auto level_set = ball<D>();
  Backward<> advection({.octaves = 1e-9});
  const auto step = [&](int n) {
    const Vec<D> u = Vec<D>::constant(n % 2 == 0 ? 0.1 : -0.1);
    const auto report = advection.step(
        level_set, [&](const Vec<D>&, double) { return u; }, 0.0, 1.0, Serial{});
    BOOST_REQUIRE(report.reinitialisations == 1U);
  };
  BOOST_TEST(taken_by(6, step) == 0U);
}

// Threads of their own get buffers of their own, once.
BOOST_AUTO_TEST_CASE(backward_steps_of_threads) {
  auto level_set = ball<2>();
  Backward<> advection;
  const auto still = [](const Vec<2>&, double) { return Vec<2>{}; };
  const auto step = [&](int) { advection.step(level_set, still, 0.0, 1.0, OpenMP{2}); };
  taken_by(20, step);
  // Which of the threads works on a block is chance: now and then one meets a larger one than before.
  BOOST_TEST(taken_by(20, step) < 20U);
}
