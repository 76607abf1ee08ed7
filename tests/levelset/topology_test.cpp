// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE topology
#include "levelset/topology.hpp"

#include <boost/test/unit_test.hpp>

using namespace topology;

namespace {

/// Measured: volume 1.3% (1.7% when carried) for the lobes in 3D, 0.7% for the others; distance 1e-4 h (0.06 h when
/// carried).
void check_default(const Summary& worst) {
  BOOST_TEST(worst.errors == 0U);
  BOOST_TEST(worst.wrong_counts == 0U);
  BOOST_TEST(worst.volume < 0.03);
  BOOST_TEST(worst.distance < 0.1);
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(closest_points_of_shapes, Dim, Dimensions) {
  check_default(check_sampled<ClosestPoint, Dim::value>("ClosestPoint"));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(backward_advection, Dim, Dimensions) {
  constexpr int D = Dim::value;
  check_default(check<Merging<D>>("Backward merging", carried<ClosestPoint, Merging<D>, D>(Backward<>())));
  check_default(check<Pinching<D>>("Backward pinching", carried<ClosestPoint, Pinching<D>, D>(Backward<>())));
}
