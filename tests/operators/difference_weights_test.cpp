// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE difference_weights
#include <boost/multiprecision/cpp_int.hpp>
#include <boost/test/unit_test.hpp>

#include <cambium/operators/difference_weights.hpp>

using namespace cambium;
using Rational = boost::multiprecision::cpp_rational;

BOOST_AUTO_TEST_CASE(weights_are_the_known_fractions) {
  const auto first = difference_weights<Rational>(1, std::array<int, 5>{-2, -1, 0, 1, 2});
  const std::array<Rational, 5> known{Rational(1, 12), Rational(-2, 3), Rational(0), Rational(2, 3), Rational(-1, 12)};
  BOOST_TEST((first == known));
  const auto second = difference_weights<Rational>(2, std::array<int, 7>{-3, -2, -1, 0, 1, 2, 3});
  BOOST_TEST((second[0] == Rational(1, 90) && second[1] == Rational(-3, 20) && second[2] == Rational(3, 2) &&
              second[3] == Rational(-49, 18)));
  const auto one_sided = difference_weights<Rational>(1, std::array<int, 3>{0, 1, 2});
  BOOST_TEST((one_sided[0] == Rational(-3, 2) && one_sided[1] == 2 && one_sided[2] == Rational(-1, 2)));
}

/// Every stored weight is the exact fraction rounded, and the fractions satisfy all moment conditions exactly.
template <int Order, int Derivative>
void check_table() {
  using Table = DifferenceTable<Order, Derivative>;
  constexpr std::size_t n = Table::one_sided_nodes;
  for (int before = 0; before < Table::half; ++before) {
    const auto offsets = Table::template offsets<n>(before);
    const auto exact = difference_weights<Rational>(Derivative, offsets);
    for (int power = 0; power < static_cast<int>(n); ++power) {
      Rational sum = 0;
      for (std::size_t k = 0; k < n; ++k) {
        Rational term = exact[k];
        for (int a = 0; a < power; ++a) term *= offsets[k];
        sum += term;
      }
      BOOST_TEST((sum == (power == Derivative ? Derivative : 0)));
    }
    for (std::size_t k = 0; k < n; ++k) {
      // Integers below 2^53 and one division: correctly rounded.
      BOOST_TEST(Table::one_sided[static_cast<std::size_t>(before)][k] == exact[k].template convert_to<double>());
    }
  }
  const auto exact = difference_weights<Rational>(Derivative, Table::template offsets<Order + 1>(Table::half));
  for (std::size_t k = 0; k <= Order; ++k) BOOST_TEST(Table::centred[k] == exact[k].template convert_to<double>());
}

BOOST_AUTO_TEST_CASE(tables_are_exact) {
  check_table<2, 1>();
  check_table<2, 2>();
  check_table<4, 1>();
  check_table<4, 2>();
  check_table<6, 1>();
  check_table<6, 2>();
}
