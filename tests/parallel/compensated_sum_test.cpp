// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE compensated_sum
#include <boost/test/unit_test.hpp>

#include <cambium/parallel/compensated_sum.hpp>

using namespace cambium;

namespace {

/// 1 + 1e100 + 1 - 1e100 = 2, Neumaier's example, which a plain sum and Kahan's make 0.
constexpr double neumaiers_example() {
  CompensatedSum sum;
  for (const double term : {1.0, 1e100, 1.0, -1e100}) sum += term;
  return sum.value();
}
static_assert(neumaiers_example() == 2.0);

}  // namespace

BOOST_AUTO_TEST_CASE(small_terms_beside_a_large_one_are_kept) {
  CompensatedSum sum;
  sum += 1.0;
  for (int i = 0; i < 100000; ++i) sum += 1e-17;  // each alone is lost
  BOOST_TEST(sum.value() == 1.0 + 1e-12);
}

BOOST_AUTO_TEST_CASE(parts_are_joined_with_their_round_off) {
  CompensatedSum a, b;
  for (const double term : {1e16, 1.0}) a += term;
  for (const double term : {1.0, -1e16}) b += term;
  BOOST_TEST((a + b).value() == 2.0);
  BOOST_TEST((a + -1e16).value() == 1.0);
  BOOST_TEST(CompensatedSum{}.value() == 0.0);
}
