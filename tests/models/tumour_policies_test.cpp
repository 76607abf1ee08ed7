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
