// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE topology_pde
#include <boost/test/unit_test.hpp>

#include "levelset/topology.hpp"

using namespace topology;

BOOST_AUTO_TEST_CASE_TEMPLATE(pde, Dim, Dimensions) {
  constexpr int D = Dim::value;
  // Measured: volume 2.0%, and 0.6% with a subcell fix.
  const Summary plain = check_sampled<PdeReinit<>, D>("PdeReinit", {}, 1.5);
  BOOST_TEST(plain.errors == 0U);
  BOOST_TEST(plain.volume < 0.04);
  for (const SubcellFix fix : {SubcellFix::russo_smereka, SubcellFix::high_order}) {
    const Summary fixed = check_sampled<PdeReinit<>, D>("PdeReinit, fixed", {.subcell_fix = fix}, 1.5);
    BOOST_TEST(fixed.errors == 0U);
    BOOST_TEST(fixed.wrong_counts == 0U);
    BOOST_TEST(fixed.volume < 0.015);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(gradient_normalised, Dim, Dimensions) {
  const Summary worst = check_sampled<GradientNormalised, Dim::value>("GradientNormalised");
  BOOST_TEST(worst.errors == 0U);
  BOOST_TEST(worst.wrong_counts == 0U);
  BOOST_TEST(worst.volume < 0.03);
}
