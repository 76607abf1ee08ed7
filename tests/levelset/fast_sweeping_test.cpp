// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE fast_sweeping
#include <boost/test/unit_test.hpp>

#include <cambium/levelset/reinit/fast_marching.hpp>
#include <cambium/levelset/reinit/fast_sweeping.hpp>
#include <cambium/levelset/reinit/linear_kick_off.hpp>

#include "levelset/marching.hpp"

using namespace cambium;
using namespace marching;

static_assert(Reinitialisation<FastSweeping<>> && Reinitialisation<FastSweeping<LinearKickOff>>);

BOOST_AUTO_TEST_CASE_TEMPLATE(first_order, Case, Dimensions) {
  const Orders orders = measured_orders<FastSweeping<>, Case::value>(true);
  // Theory: 1 in a band of fixed width, from below; 2 within a fixed number of spacings of nodes that are exact.
  BOOST_TEST(orders.far > 0.7);
  BOOST_TEST(orders.far < 1.1);
  BOOST_TEST(orders.near > 1.7);
}

/// Sweeping and marching solve the same equations.
BOOST_AUTO_TEST_CASE_TEMPLATE(equal_to_marching, Case, Dimensions) {
  constexpr int D = Case::value;
  const auto compare = [](auto start, auto kick_off) {
    using Start = decltype(kick_off);
    auto marched = start;
    auto swept = start;
    reinitialise<FastMarching<Start, 1>>(marched);
    reinitialise<FastSweeping<Start>>(swept);
    BOOST_TEST(difference(marched, swept) < 1e-13);
  };
  for (const int n : {36, 50}) {
    compare(balls_band<double, D>(n, 0.1, 7.0 / n), ChoppKickOff{});
    compare(balls_band<double, D>(n, 0.1, 7.0 / n), LinearKickOff{});
    compare(ellipsoid_band<double, D>(n, 0.2, true), ChoppKickOff{});
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(contract, Case, Dimensions) {
  check_contract<FastSweeping<>, double, Case::value>();
  check_contract<FastSweeping<LinearKickOff>, float, Case::value>();
}

/// A convex shape is swept once in every order, and no node is left to visit but for rounding.
BOOST_AUTO_TEST_CASE_TEMPLATE(few_sweeps, Case, Dimensions) {
  constexpr int D = Case::value;
  auto band = ellipsoid_band<double, D>(50, 0.12, false);
  const ReinitReport report = reinitialise<FastSweeping<>>(band);
  BOOST_TEST(report.iterations <= (2U << D));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(periodic_faces, Case, Dimensions) { check_periodic_faces<FastSweeping<>, Case::value>(); }

BOOST_AUTO_TEST_CASE_TEMPLATE(threads, Case, Dimensions) { check_threads<FastSweeping<>, Case::value>(); }

BOOST_AUTO_TEST_CASE_TEMPLATE(touching_balls, Case, Dimensions) { check_touching_balls<FastSweeping<>, Case::value>(); }

BOOST_AUTO_TEST_CASE(not_finite) { check_not_finite<FastSweeping<>>(); }

BOOST_AUTO_TEST_CASE(no_allocation) { check_no_allocation<FastSweeping<>>(); }
