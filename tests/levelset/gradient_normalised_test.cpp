// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE gradient_normalised
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <tuple>

#include <cambium/levelset/reinit/gradient_normalised.hpp>

#include "levelset/scaled_ball.hpp"
#include "support/order.hpp"

using namespace cambium;

namespace {

template <int N>
using Dimension = std::integral_constant<int, N>;
using Dimensions = std::tuple<Dimension<2>, Dimension<3>>;

template <int D, class T = double>
double error(int cells, double range) {
  const LevelSet<GradientNormalised, D, T> set(support::box_of_ball<D>(cells), support::ScaledBall<D>{range}, {},
                                               Serial{});
  return support::distance_error(set.band(), 3.0, support::OffCentreBall<D>());
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(second_order_within_some_spacings, Dim, Dimensions) {
  constexpr int D = Dim::value;
  // A distance s away the error is s^2 / 2 times the slope of log |grad phi|: s is 3 h here.
  const int n = D == 2 ? 64 : 32;
  const double order = support::observed_order(error<D>(n, 2.0), error<D>(2 * n, 2.0));
  BOOST_TEST_MESSAGE("order " << order << " error " << error<D>(n, 2.0));
  BOOST_TEST(order > 1.8);
  BOOST_TEST(order < 3.0);
}

BOOST_AUTO_TEST_CASE(a_factor_that_is_constant_is_taken_out) {
  const auto scaled = [](double factor) {
    const LevelSet<GradientNormalised, 2> set(
        support::box_of_ball<2>(64), [=](const Vec<2>& x) { return factor * support::OffCentreBall<2>()(x); }, {},
        Serial{});
    return support::distance_error(set.band(), 3.0, support::OffCentreBall<2>());
  };
  // The derivatives are of order 5; measured 2.9e-7 for a distance.
  BOOST_TEST(scaled(7.0) < 1e-6);
  BOOST_TEST(scaled(0.2) < 1e-6);
}

BOOST_AUTO_TEST_CASE(nodes_keep_their_side_and_zeros_stay) {
  // A circle through nodes of the lattice.
  const auto circle = [](const Vec<2>& x) { return 3.0 * (norm(x) - 0.5); };
  const LevelSet<GradientNormalised, 2> set(support::box_of_ball<2>(64), circle, {}, Serial{});
  BOOST_TEST(set.band()({48, 32}) == 0.0);
  bool same_side = true;
  support::for_each_stored(set.band(), [&](const Index<2>& node, double phi) {
    same_side = same_side && (phi < 0.0) == (circle(set.lattice().position(node)) < 0.0);
  });
  BOOST_TEST(same_side);
}

BOOST_AUTO_TEST_CASE(single_precision) { BOOST_TEST(std::abs(error<2, float>(64, 2.0) - error<2>(64, 2.0)) < 1e-5); }

BOOST_AUTO_TEST_CASE(same_bits_for_any_number_of_threads) {
  const LevelSet<GradientNormalised, 3> one(support::box_of_ball<3>(32), support::ScaledBall<3>{4.0}, {}, OpenMP{1});
  for (const int threads : {2, 3}) {
    const LevelSet<GradientNormalised, 3> more(support::box_of_ball<3>(32), support::ScaledBall<3>{4.0}, {},
                                               OpenMP{threads});
    BOOST_TEST(support::same_bits(one.band(), more.band()));
  }
}

BOOST_AUTO_TEST_CASE(values_that_are_not_finite) {
  const LevelSet<GradientNormalised, 2> set(support::box_of_ball<2>(32), support::OffCentreBall<2>(), {}, Serial{});
  NarrowBand<double, 2> band = set.band();
  band.values().block(0)[5] = std::numeric_limits<double>::infinity();
  GradientNormalised::Method<double, 2> method;
  BOOST_CHECK_THROW(method(band, Serial{}), ValueError);
}
