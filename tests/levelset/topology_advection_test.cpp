// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE topology_advection
#include <boost/test/unit_test.hpp>

#include "levelset/topology.hpp"

using namespace topology;

BOOST_AUTO_TEST_CASE_TEMPLATE(eulerian_advection, Dim, Dimensions) {
  constexpr int D = Dim::value;
  for (const Summary& worst : {check<Merging<D>>("merging", carried<ClosestPoint, Merging<D>, D>(Eulerian<>())),
                               check<Pinching<D>>("pinching", carried<ClosestPoint, Pinching<D>, D>(Eulerian<>()))}) {
    BOOST_TEST(worst.errors == 0U);
    BOOST_TEST(worst.volume < 0.04);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(lagrangian_advection, Dim, Dimensions) {
  constexpr int D = Dim::value;
  for (const Summary& worst : {check<Merging<D>>("merging", carried<ClosestPoint, Merging<D>, D>(Lagrangian<>())),
                               check<Pinching<D>>("pinching", carried<ClosestPoint, Pinching<D>, D>(Lagrangian<>()))}) {
    BOOST_TEST(worst.volume < 0.04);
  }
}
