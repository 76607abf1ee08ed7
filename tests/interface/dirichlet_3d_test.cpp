// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE dirichlet_3d
#include <boost/test/unit_test.hpp>
#include <tuple>

#include "dirichlet_scenes.hpp"

using namespace cambium;

namespace {

using Cases = std::tuple<scenes::Case<scenes::Oval<3>, Side::inside>, scenes::Case<scenes::Oval<3>, Side::outside>,
                         scenes::Case<scenes::Ring, Side::inside>>;

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(second_order_with_its_gradient_at_the_interface, C, Cases) {
  scenes::check_orders<C>(1.8, 1.8);
}

BOOST_AUTO_TEST_CASE(nutrient_of_a_ball) {
  const scenes::Errors fine = scenes::check_nutrient<3>(32);
  BOOST_CHECK_LT(fine.derivative, 0.0025);  // of coth 2 - 1/2 = 0.537, h = 3/32
}
