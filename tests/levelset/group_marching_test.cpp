// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE group_marching
#include <boost/test/unit_test.hpp>

#include <cambium/levelset/reinit/fast_marching.hpp>
#include <cambium/levelset/reinit/group_marching.hpp>
#include <cambium/levelset/reinit/linear_kick_off.hpp>

#include "levelset/marching.hpp"

using namespace cambium;
using namespace marching;

static_assert(Reinitialisation<GroupMarching<>> && Reinitialisation<GroupMarching<LinearKickOff>>);

BOOST_AUTO_TEST_CASE_TEMPLATE(first_order, Case, Dimensions) {
  const Orders orders = measured_orders<GroupMarching<>, Case::value>(true);
  // Theory: 1 in a band of fixed width, from below; 2 within a fixed number of spacings of nodes that are exact.
  BOOST_TEST(orders.far > 0.7);
  BOOST_TEST(orders.far < 1.1);
  BOOST_TEST(orders.near > 1.7);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(close_to_fast_marching, Case, Dimensions) {
  constexpr int D = Case::value;
  double largest = 0.0;
  for (const int n : {36, 50}) {
    auto single = balls_band<double, D>(n, 0.1, 7.0 / n);
    auto grouped = single;
    reinitialise<FastMarching<ChoppKickOff, 1>>(single);
    reinitialise<GroupMarching<>>(grouped);
    largest = std::max(largest, difference(single, grouped) * n);
    auto convex = ellipsoid_band<double, D>(n, 0.12, true);
    auto convex_grouped = convex;
    reinitialise<FastMarching<ChoppKickOff, 1>>(convex);
    reinitialise<GroupMarching<>>(convex_grouped);
    largest = std::max(largest, difference(convex, convex_grouped) * n);
  }
  BOOST_TEST_MESSAGE(D << "D: differs by " << largest << " h");
  // Two passes over a group leave what depends on a third: far below the error of the scheme (about 0.1 h).
  BOOST_TEST(largest < 1e-3);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(contract, Case, Dimensions) {
  check_contract<GroupMarching<>, double, Case::value>();
  check_contract<GroupMarching<LinearKickOff>, float, Case::value>();
}

BOOST_AUTO_TEST_CASE_TEMPLATE(threads, Case, Dimensions) { check_threads<GroupMarching<>, Case::value>(); }

BOOST_AUTO_TEST_CASE_TEMPLATE(touching_balls, Case, Dimensions) {
  check_touching_balls<GroupMarching<>, Case::value>();
}

BOOST_AUTO_TEST_CASE(not_finite) { check_not_finite<GroupMarching<>>(); }

BOOST_AUTO_TEST_CASE(no_allocation) { check_no_allocation<GroupMarching<>>(); }
