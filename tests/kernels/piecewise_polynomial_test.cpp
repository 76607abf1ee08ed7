// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE piecewise_polynomial
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include <cambium/kernels/piecewise_polynomial.hpp>

#include "exact.hpp"

using exact::Rational;

namespace {

/// Largest |W(x) - exact W(x)| over points that are no simple fractions, in units of the type's epsilon.
template <class T>
double largest_error(T (*value)(T), const exact::Kernel& w) {
  Rational largest = 0;
  for (int i = 0; i < 1000; ++i) {
    const T x = static_cast<T>(0.6 * w.support * std::fmod(i * 0.6180339887498949, 1.0));
    const Rational error = abs(Rational(static_cast<double>(value(x))) - w.value(Rational(static_cast<double>(x))));
    if (error > largest) largest = error;
  }
  return static_cast<double>(largest) / static_cast<double>(std::numeric_limits<T>::epsilon());
}

/// Largest relative error of coefficients about the middle of a piece, which are W^(m) / m! there.
double largest_coefficient_error(double (*centred)(int, int), double middle, const exact::Kernel& w) {
  double largest = 0.0;
  for (int i = 0; i < w.pieces(); ++i) {
    Rational factorial = 1;
    for (int m = 0; m <= w.degree(); ++m) {
      if (m > 0) factorial *= m;
      const double expected = static_cast<double>(w.derivative(i, m, Rational(middle + i)) / factorial);
      const double error = std::abs(centred(i, m) - expected);
      largest = std::max(largest, expected == 0.0 ? error : error / std::abs(expected));
    }
  }
  return largest;
}

}  // namespace

// Round-off of a polynomial of degree <= 9 in |g| <= 1/2: coefficients of at most 2.8 (about the middle), each right to
// half a unit, and one rounding of at most the value, here at most 1, at each step of Horner's rule that matters.
// Measured: at most 0.51 in double, 0.64 in float.
BOOST_AUTO_TEST_CASE_TEMPLATE(values_lose_no_digits, K, exact::Kernels) {
  const auto w = exact::kernel<K>();
  BOOST_TEST(largest_error<double>(&K::template value<double>, w) <= 1.0);
  BOOST_TEST(largest_error<float>(&K::template value<float>, w) <= 1.0);
  BOOST_TEST(largest_coefficient_error([](int i, int m) { return K::pieces.centred(i, m); }, K::pieces.middle(0), w) <=
             3e-16);
  for (int k = -K::support; k <= K::support; ++k) {
    const double expected = static_cast<double>(w.value(k));
    BOOST_TEST(std::abs(K::value(static_cast<double>(k)) - expected) <= 2.3e-16);
  }
}

using Few = std::tuple<cambium::Hat, cambium::M3, cambium::M6, cambium::Lambda84>;

// The library's own evaluation in exact arithmetic.
BOOST_AUTO_TEST_CASE_TEMPLATE(exact_values, K, Few) {
  const auto w = exact::kernel<K>();
  bool even = true, supported = true, same = true;
  for (int i = 0; i <= 20 * K::support; ++i) {
    const Rational x(i, 20);
    const Rational value = K::value(x);
    even = even && value == K::value(-x);
    same = same && value == w.value(x);
    supported = supported && (2 * x < K::support || value == 0);
  }
  BOOST_TEST(even);
  BOOST_TEST(supported);
  BOOST_TEST(same);
}

BOOST_AUTO_TEST_CASE(values_are_constant_expressions) {
  static_assert(cambium::M4Prime::value(0.5) == 0.5625);
  static_assert(cambium::M4Prime::value(-0.5F) == 0.5625F);
  static_assert(cambium::M3::value(0.25) == 0.6875);
}

BOOST_AUTO_TEST_CASE(not_a_number_stays_one) {
  BOOST_TEST(std::isnan(cambium::M6::value(std::numeric_limits<double>::quiet_NaN())));
  BOOST_TEST(cambium::M6::value(std::numeric_limits<double>::infinity()) == 0.0);
}
