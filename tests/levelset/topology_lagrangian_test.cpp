// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE topology_lagrangian
#include <boost/test/unit_test.hpp>

#include "levelset/topology.hpp"

using namespace topology;

// It finds changes of sign far from the interface, next to the wall of the box: an error, always.
BOOST_AUTO_TEST_CASE_TEMPLATE(lagrangian, Dim, Dimensions) {
  const Summary worst = check_sampled<LagrangianReinit<>, Dim::value>("LagrangianReinit", {}, 1.5);
  BOOST_TEST(worst.errors > 0U);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(upwind_lagrangian, Dim, Dimensions) {
  const Summary worst = check_sampled<UpwindLagrangianReinit<>, Dim::value>("UpwindLagrangianReinit", {}, 1.5);
  BOOST_TEST(worst.errors == 0U);
  BOOST_TEST(worst.volume < 0.09);
}
