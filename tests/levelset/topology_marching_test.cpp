// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE topology_marching
#include <boost/test/unit_test.hpp>

#include "levelset/topology.hpp"

using namespace topology;

namespace {

/// Measured: volume 1.1%, and 5.2% for the lobes in 3D by the linear kick-off.
void check_marching(const Summary& worst, double volume = 0.03) {
  BOOST_TEST(worst.errors == 0U);
  BOOST_TEST(worst.wrong_counts == 0U);
  BOOST_TEST(worst.volume < volume);
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(fast_marching, Dim, Dimensions) {
  check_marching(check_sampled<FastMarching<>, Dim::value>("FastMarching"));
}
BOOST_AUTO_TEST_CASE_TEMPLATE(fast_sweeping, Dim, Dimensions) {
  check_marching(check_sampled<FastSweeping<>, Dim::value>("FastSweeping"));
}
BOOST_AUTO_TEST_CASE_TEMPLATE(group_marching, Dim, Dimensions) {
  check_marching(check_sampled<GroupMarching<>, Dim::value>("GroupMarching"));
}
BOOST_AUTO_TEST_CASE_TEMPLATE(group_marching_linear, Dim, Dimensions) {
  check_marching(check_sampled<GroupMarching<LinearKickOff>, Dim::value>("GroupMarching<LinearKickOff>"), 0.08);
}
