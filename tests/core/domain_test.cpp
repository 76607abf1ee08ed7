// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE domain
#include <boost/test/unit_test.hpp>
#include <random>

#include <cambium/core/domain.hpp>

using namespace cambium;

namespace {

/// Axis 0 periodic with period 2, axis 1 bounded.
const Domain<2> mixed{{{-0.5, 0.0}, {1.5, 1.0}}, {true, false}};

}  // namespace

BOOST_AUTO_TEST_CASE(makers) {
  BOOST_TEST((Domain<3>::periodic_box(Box<3>::cube()).periodic == std::array{true, true, true}));
  BOOST_TEST((Domain<3>::bounded_box(Box<3>::cube()).periodic == std::array{false, false, false}));
}

BOOST_AUTO_TEST_CASE(difference_takes_the_nearest_image_along_periodic_axes) {
  BOOST_TEST((mixed.difference({1.25, 0.25}, {-0.25, 1.0}) == Vec<2>{0.5, 0.75}));
  BOOST_TEST((mixed.difference({-0.25, 1.0}, {1.25, 0.25}) == Vec<2>{-0.5, -0.75}));
  BOOST_TEST((mixed.difference({0.0, 0.0}, {7.25, 0.0}) == Vec<2>{-0.75, 0.0}));  // any number of periods away
  // At half a period there are two nearest images; the two ways round are opposite.
  BOOST_TEST((mixed.difference({0.0, 0.0}, {1.0, 0.0}) == Vec<2>{-1.0, 0.0}));
  BOOST_TEST((mixed.difference({1.0, 0.0}, {0.0, 0.0}) == Vec<2>{1.0, 0.0}));
}

BOOST_AUTO_TEST_CASE(wrap_goes_into_the_half_open_period) {
  BOOST_TEST((mixed.wrap({1.5, 3.0}) == Vec<2>{-0.5, 3.0}));  // the upper face is the lower one; axis 1 stays
  BOOST_TEST((mixed.wrap({-0.5, -3.0}) == Vec<2>{-0.5, -3.0}));
  BOOST_TEST((mixed.wrap({-0.75, 0.5}) == Vec<2>{1.25, 0.5}));
  BOOST_TEST((mixed.wrap({9.0, 0.5}) == Vec<2>{1.0, 0.5}));
  BOOST_TEST((mixed.wrap({-0.5 - 1e-17, 0.5}) == Vec<2>{-0.5, 0.5}));
}

BOOST_AUTO_TEST_CASE(wrap_stays_inside_whatever_the_round_off) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 200000; ++i) {
    const double lo = unit(random);
    const Domain<1> domain = Domain<1>::periodic_box({{lo}, {lo + 0.1 + std::abs(unit(random))}});
    const double period = domain.box.extent()[0];
    // Points on, or a rounding away from, multiples of the period.
    const double x = lo + period * std::floor(1000.0 * unit(random)) * (1.0 + 2.0e-16 * std::floor(3.0 * unit(random)));
    const double wrapped = domain.wrap(Vec<1>{x})[0];
    if (!(wrapped >= lo && wrapped < domain.box.hi[0])) BOOST_TEST(false, "wrap left the period");
  }
}
