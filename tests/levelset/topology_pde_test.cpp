// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE topology_pde
#include <boost/test/unit_test.hpp>

#include "levelset/topology.hpp"

using namespace topology;

BOOST_AUTO_TEST_CASE_TEMPLATE(pde, Dim, Dimensions) {
  constexpr int D = Dim::value;
  // Without a subcell fix the neck of the dumbbell is lost when it is still 1.5 spacings thick, and 4% of the volume.
  const Summary plain = check_sampled<PdeReinit<>, D>("PdeReinit");
  BOOST_TEST(plain.errors == 0U);
  BOOST_TEST(plain.volume < 0.06);
  for (const SubcellFix fix : {SubcellFix::russo_smereka, SubcellFix::high_order}) {
    const Summary fixed = check_sampled<PdeReinit<>, D>("PdeReinit, fixed", {.subcell_fix = fix});
    BOOST_TEST(fixed.errors == 0U);
    BOOST_TEST(fixed.wrong_counts == 0U);
    BOOST_TEST(fixed.volume < 0.03);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(gradient_normalised, Dim, Dimensions) {
  const Summary worst = check_sampled<GradientNormalised, Dim::value>("GradientNormalised");
  BOOST_TEST(worst.errors == 0U);
  BOOST_TEST(worst.wrong_counts == 0U);
  BOOST_TEST(worst.volume < 0.03);
}

// Velocities are not smooth at the ridge between the two lobes: values from across it grow at the edge of the band,
// until the change of sign is found next to the wall of the box.
BOOST_AUTO_TEST_CASE_TEMPLATE(lagrangian, Dim, Dimensions) {
  const Summary worst = check_sampled<LagrangianReinit<>, Dim::value>("LagrangianReinit");
  BOOST_TEST(worst.errors > 0U);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(upwind_lagrangian, Dim, Dimensions) {
  const Summary worst = check_sampled<UpwindLagrangianReinit<>, Dim::value>("UpwindLagrangianReinit");
  BOOST_TEST(worst.errors == 0U);
  BOOST_TEST(worst.volume < 0.09);
}
