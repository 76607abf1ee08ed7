// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE delta_function
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <tuple>

#include <cambium/kernels/delta3.hpp>
#include <cambium/kernels/delta4.hpp>
#include <cambium/kernels/delta6.hpp>
#include <cambium/kernels/delta_cosine.hpp>
#include <cambium/kernels/delta_function.hpp>
#include <cambium/kernels/hat.hpp>

using namespace cambium;

namespace {

using Deltas = std::tuple<Hat, Delta3, Delta4, DeltaCosine, Delta6>;

constexpr int offsets = 1000;

/// sum_j (j - t)^a phi(t - j)^power over j of one parity (0, 1) or all (-1), in run-time arithmetic.
template <class K>
double sum_over_nodes(double t, int a, int power = 1, int parity = -1) {
  double sum = 0.0;
  for (int j = -8; j <= 8; ++j) {
    if (parity >= 0 && (j + 8) % 2 != parity) continue;
    sum += std::pow(j - t, a) * std::pow(K::value(t - j), power);
  }
  return sum;
}

/// Largest deviation of a sum over nodes from `expected`, over all offsets.
template <class K>
double deviation(double expected, int a, int power = 1, int parity = -1) {
  double largest = 0.0;
  for (int i = 0; i < offsets; ++i) {
    const double t = static_cast<double>(i) / offsets;
    largest = std::max(largest, std::abs(sum_over_nodes<K>(t, a, power, parity) - expected));
  }
  return largest;
}

}  // namespace

// Tolerances: round-off of at most 6 terms of at most 3^3.
BOOST_AUTO_TEST_CASE_TEMPLATE(moments_hold_and_the_next_fails, K, Deltas) {
  BOOST_CHECK_NO_THROW(check_delta_function<K>());
  for (int a = 0; a <= K::moments; ++a) BOOST_TEST(deviation<K>(a == 0 ? 1.0 : 0.0, a) < 1e-14);
  BOOST_TEST(deviation<K>(0.0, K::moments + 1) > 1e-2);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(peskins_conditions, K, Deltas) {
  if constexpr (requires { K::even_odd; }) {
    for (int parity = 0; parity < 2; ++parity) BOOST_TEST((deviation<K>(0.5, 0, 1, parity) < 1e-14) == K::even_odd);
  }
  if constexpr (requires { K::sum_of_squares; }) BOOST_TEST(deviation<K>(K::sum_of_squares, 0, 2) < 1e-14);
  if constexpr (requires { K::constant_moments; }) {
    for (int a = 0; a < 4; ++a) BOOST_TEST(deviation<K>(K::constant_moments[a], a) < 2e-14);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(non_negative_and_even, K, Deltas) {
  static_assert(is_non_negative<K>);
  for (int i = 0; i <= offsets; ++i) {
    const double x = 0.6 * K::support * i / offsets;
    BOOST_REQUIRE(K::value(x) >= -1e-16);
    BOOST_REQUIRE_EQUAL(K::value(x), K::value(-x));
  }
}

/// Jump of a derivative at x, by one-sided differences; 0 if there is none.
template <class K>
double jump(double x, int order) {
  const auto left = detail::one_sided_derivatives<K>(x, -1.0 / 128.0);
  const auto right = detail::one_sided_derivatives<K>(x, 1.0 / 128.0);
  return std::abs(right.value[order] - left.value[order]);
}

// Continuity is exact: the next derivative jumps by what the formulas give.
BOOST_AUTO_TEST_CASE(continuity_class_is_exact) {
  static_assert(DeltaCosine::continuity == 1 && Delta4::continuity == 1 && Delta3::continuity == 1);
  static_assert(Delta6::continuity == 3);
  const double quarter_pi = std::acos(-1.0) / 4.0;
  BOOST_TEST(std::abs(jump<DeltaCosine>(2.0, 2) - quarter_pi * quarter_pi) < 1e-6);  // (pi/2)^2 / 4
  // Inner side at 2: s = 12 r - 7 - 4 r^2 = 1, s' = -4, s'' = -8: -(sqrt s)''/8 = -(s''/2 - s'^2/4)/8 = 1.
  BOOST_TEST(std::abs(jump<Delta4>(2.0, 2) - 1.0) < 1e-5);
  // Inner side at 3/2: s = 1 - 3 (1 - r)^2 = 1/4, s' = 3, s'' = -6: -(s''/(2 sqrt s) - s'^2/(4 s^(3/2)))/6 = 4.
  BOOST_TEST(std::abs(jump<Delta3>(1.5, 2) - 4.0) < 1e-2);
  for (int k = 0; k <= 3; ++k) {
    for (int order = 0; order <= 3; ++order) BOOST_TEST(jump<Delta6>(k, order) < 1e-5);
  }
  BOOST_TEST(jump<Delta6>(3.0, 4) > 0.1);
}

BOOST_AUTO_TEST_CASE(values_at_nodes) {
  BOOST_TEST(std::abs(Delta3::value(0.0) - 2.0 / 3.0) < 1e-16);
  BOOST_TEST(std::abs(Delta3::value(1.0) - 1.0 / 6.0) < 1e-16);
  BOOST_TEST(Delta4::value(0.0) == 0.5);
  BOOST_TEST(Delta4::value(1.0) == 0.25);
  BOOST_TEST(DeltaCosine::value(0.0) == 0.5);
  // K = 59/60 - sqrt(29)/20; phi(0) = 5/8 - K/4, phi(1) = 1/4, phi(2) = K/8 - 1/16, phi(3) = 0
  const double moment = 59.0 / 60.0 - std::sqrt(29.0) / 20.0;
  BOOST_TEST(std::abs(Delta6::value(0.0) - (0.625 - moment / 4.0)) < 2e-16);
  BOOST_TEST(std::abs(Delta6::value(1.0) - 0.25) < 1e-16);
  BOOST_TEST(std::abs(Delta6::value(2.0) - (moment / 8.0 - 0.0625)) < 1e-16);
  BOOST_TEST(Delta6::value(3.0) == 0.0);
}

// The constant expressions are the run-time functions to round-off, so that what is checked is what runs.
BOOST_AUTO_TEST_CASE(constant_functions_agree_with_the_standard_ones) {
  static_assert(square_root(4.0) == 2.0 && square_root(0.0) == 0.0 && square_root(0.25) == 0.5);
  constexpr double root = square_root(2.0), tiny = square_root(1e-300), e = exponential(1.0),
                   less = exponential(-40.25);
  constexpr double third = cosine(1.0471975511965976), zero = exponential(-1e6), far = cosine(30.0);
  BOOST_TEST(std::abs(root - std::sqrt(2.0)) <= 2.3e-16);
  BOOST_TEST(std::abs(tiny / 1e-150 - 1.0) <= 2.3e-16);
  BOOST_TEST(std::abs(e - std::exp(1.0)) <= 4.5e-16);
  BOOST_TEST(std::abs(less / std::exp(-40.25) - 1.0) <= 1e-14);
  BOOST_TEST(zero == 0.0);
  BOOST_TEST(std::abs(third - 0.5) <= 1e-15);
  BOOST_TEST(std::abs(far - std::cos(30.0)) <= 1e-14);
}
