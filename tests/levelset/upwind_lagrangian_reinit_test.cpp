// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE upwind_lagrangian_reinit
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <tuple>

#include <cambium/levelset/reinit/upwind_lagrangian_reinit.hpp>

#include "levelset/scaled_ball.hpp"
#include "support/order.hpp"

using namespace cambium;

namespace {

template <int N>
using Dimension = std::integral_constant<int, N>;
using Dimensions = std::tuple<Dimension<2>, Dimension<3>>;

template <int D, class T = double>
double error(int cells, double range) {
  const LevelSet<UpwindLagrangianReinit<>, D, T> set(support::box_of_ball<D>(cells), support::ScaledBall<D>{range}, {},
                                                     Serial{});
  return support::distance_error(set.band(), 3.0, support::OffCentreBall<D>());
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_distance_stays_one) {
  // From the exact distance: order 5 of the derivative, as long as the interface has not moved.
  const double order = support::observed_order(error<2>(32, 1.0), error<2>(64, 1.0));
  BOOST_TEST_MESSAGE("order " << order);
  BOOST_TEST(order > 4.5);
  LevelSet<UpwindLagrangianReinit<>, 2> set(support::box_of_ball<2>(48), support::OffCentreBall<2>(), {}, Serial{});
  for (int call = 0; call < 10; ++call) set.reinitialise(Serial{});
  BOOST_TEST(support::distance_error(set.band(), 3.0, support::OffCentreBall<2>()) < 0.02 * set.spacing());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(first_order_from_a_badly_scaled_phi, Dim, Dimensions) {
  constexpr int D = Dim::value;
  const int n = D == 2 ? 48 : 20;
  const double order = support::observed_order(error<D>(n, 4.0), error<D>(2 * n, 4.0));
  BOOST_TEST_MESSAGE("order " << order << " error " << error<D>(2 * n, 4.0));
  // Nodes on either side of the interface are scaled by factors of their own: it moves by a multiple of h.
  // Measured 1.4 in 2D and 0.5 in 3D.
  BOOST_TEST(order > 0.3);
  BOOST_TEST(order < 1.9);
}

BOOST_AUTO_TEST_CASE(single_precision) { BOOST_TEST(std::abs(error<2, float>(48, 4.0) - error<2>(48, 4.0)) < 1e-4); }

BOOST_AUTO_TEST_CASE(same_bits_for_any_number_of_threads) {
  LevelSet<UpwindLagrangianReinit<>, 2>::Params all;
  all.reinit.iterations = 3;
  const auto box = support::box_of_ball<2>(48);
  const LevelSet<UpwindLagrangianReinit<>, 2> one(box, support::ScaledBall<2>{4.0}, all, OpenMP{1});
  for (const int threads : {2, 3}) {
    const LevelSet<UpwindLagrangianReinit<>, 2> more(box, support::ScaledBall<2>{4.0}, all, OpenMP{threads});
    BOOST_TEST(support::same_bits(one.band(), more.band()));
  }
}

BOOST_AUTO_TEST_CASE(bad_options) {
  using Method = UpwindLagrangianReinit<>::Method<double, 2>;
  BOOST_CHECK_THROW(Method({.iterations = -1}), ValueError);
  BOOST_CHECK_THROW(Method({.cfl = 1.5}), ValueError);
}
