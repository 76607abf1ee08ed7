// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE tumour_policies
#include <boost/test/unit_test.hpp>

#include "tumour_scenes.hpp"

using namespace cambium;
using namespace scenes;

// R(t) from R(0) = 2 by quadrature in 40 digits: A = 0.5, G = 20, G_N = 1.

BOOST_AUTO_TEST_CASE(a_necrotic_core_slows_growth_down_and_the_outside_does_not_matter) {
  using Necrotic = Tumour<2, ZeroOutside, Necrosis>;
  BOOST_TEST(std::abs(radius_error<Necrotic>(48, 0.1, 2.07128418372)) < 1e-3);
}
BOOST_AUTO_TEST_CASE(balls_grow_as_the_exact_equation_says) {
  BOOST_TEST(std::abs(radius_error<Tumour<3>>(40, 0.05, 2.20409982622)) < 1e-3);
}

// The reference by Chebyshev polynomials on the ball mapped to that of radius 1, and Radau's method: 10 digits.
BOOST_AUTO_TEST_CASE(balls_whose_nutrient_diffuses_grow_as_their_radial_equations_say) {
  using Slow = Tumour<2, Diffusing, SemiImplicit>;
  const double coarse = radius_error<Slow>(24, 0.1, 2.5410591878), fine = radius_error<Slow>(48, 0.1, 2.5410591878);
  BOOST_TEST(std::abs(fine) < 3e-3);                     // measured 2.3e-3 and, at 96 cells, 6.3e-4
  BOOST_TEST(std::abs(fine) < 0.35 * std::abs(coarse));  // 1/4 in theory, both h and dt being halved
}
BOOST_AUTO_TEST_CASE(a_step_that_fails_gives_the_nutrient_back) {
  Tumour<2, Diffusing, SemiImplicit> tumour(lattice<2>(48), ball<2>(3.0), {.parameters = {.tension = 0.005}});
  double before = 0.0;
  const auto run = [&] {
    for (int i = 0; i < 100; ++i) {
      before = tumour.nutrient()(Index<2>::constant(24));
      tumour.step();
    }
  };
  BOOST_CHECK_THROW(run(), TumourAtWallError);
  BOOST_TEST(tumour.time() > 0.0);
  BOOST_TEST(tumour.nutrient()(Index<2>::constant(24)) == before);
}
