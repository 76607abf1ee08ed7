// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#define BOOST_TEST_MODULE levelset_amorphous
#include <boost/test/unit_test.hpp>
#include <support/surface_samples.hpp>
#include <tuple>

#include <cambium/levelset/shapes/amorphous.hpp>

using namespace cambium;

namespace {

using Dimensions = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

template <int D>
std::vector<Vec<D>> directions(int count) {
  std::vector<Vec<D>> result;
  for (const auto& x : support::random_points<D>({Vec<D>::constant(-1.0), Vec<D>::constant(1.0)}, count)) {
    if (norm(x) > 0.1) result.push_back(x / norm(x));
  }
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(the_seed_tells_the_shape, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  const Amorphous<D> a({}, 0.2, 0.4, 1), again({}, 0.2, 0.4, 1), b({}, 0.2, 0.4, 2);
  check_shape<Amorphous<D>>();
  double difference = 0.0;
  for (const auto& x : support::random_points<D>({Vec<D>::constant(-0.5), Vec<D>::constant(0.5)}, 500)) {
    BOOST_TEST(a(x) == again(x));
    difference = std::max(difference, std::abs(a.radius(x) - b.radius(x)));
  }
  BOOST_TEST(difference > 0.05);
}

// The first number of the generator for seed 1234567 as its authors give it, and a radius found once.
BOOST_AUTO_TEST_CASE(random_numbers_are_the_same_everywhere) {
  cambium::detail::SplitMix64 random(1234567);
  BOOST_TEST(random.bits() == 6457827717110365317U);
  BOOST_TEST(random.bits() == 3203168211198807973U);
  BOOST_TEST(std::abs(Amorphous<3>({}, 0.2, 0.4, 42).radius({1.0, 0.0, 0.0}) - 0.25130398840954121) < 1e-12);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_surface_stays_in_its_shell_and_uses_it, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  const Vec<D> centre = Vec<D>::constant(0.3);
  double variation = 0.0;  // measured 0.16 and 0.17 of the 0.2 there are
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Amorphous<D> body(centre, 0.2, 0.4, seed, 3.0);
    double least = 1.0, most = 0.0;
    for (const auto& n : directions<D>(500)) {
      const double r = body.radius(n);
      least = std::min(least, r);
      most = std::max(most, r);
      // Inside up to r and outside from there: the body is a star around its centre.
      for (const double part : {1e-9, 0.3, 0.7, 0.74, 0.76, 0.999}) BOOST_TEST(body(centre + part * r * n) < 0.0);
      for (const double part : {1.001, 1.5, 10.0}) BOOST_TEST(body(centre + part * r * n) > 0.0);
    }
    BOOST_TEST(least > 0.2);
    BOOST_TEST(most < 0.4);
    BOOST_TEST(most - least > 0.04);
    variation += (most - least) / 20.0;
  }
  BOOST_TEST(variation > 0.1);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_slope_is_bounded, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  double steepest = 0.0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Amorphous<D> body({}, 0.2, 0.4, seed, 5.0);
    for (const auto& x : support::random_points<D>({Vec<D>::constant(-0.5), Vec<D>::constant(0.5)}, 1000)) {
      for (const auto& n : directions<D>(8)) {
        steepest = std::max(steepest, std::abs(body(x + 1e-6 * n) - body(x)) / 1e-6);
      }
    }
  }
  BOOST_TEST(steepest < 1.0 + 1e-6);
  BOOST_TEST(steepest > 0.3);  // measured 0.47 and 0.37: the bound is not an idle one
}

BOOST_AUTO_TEST_CASE(what_is_no_shell_is_an_error) {
  BOOST_CHECK_THROW(Amorphous<2>({}, 0.0, 0.4, 1), ValueError);
  BOOST_CHECK_THROW(Amorphous<2>({}, 0.4, 0.4, 1), ValueError);
  BOOST_CHECK_THROW(Amorphous<2>({}, 0.2, 0.4, 1, 1.5), ValueError);
  BOOST_CHECK_THROW(Amorphous<2>({std::nan(""), 0.0}, 0.2, 0.4, 1), ValueError);
  BOOST_CHECK_THROW(Amorphous<2>({}, 0.2, 0.4, 1).radius({}), ValueError);
}
