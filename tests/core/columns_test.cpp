// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE columns
#include <boost/test/unit_test.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <cambium/core/columns.hpp>

using namespace cambium;

static_assert(std::is_convertible_v<Columns<2, double>, Columns<2, const double>>);
static_assert(!std::is_convertible_v<Columns<2, const double>, Columns<2, double>>);
static_assert(!std::is_convertible_v<Columns<2, double>, Columns<3, const double>>);

BOOST_AUTO_TEST_CASE(vectors_are_read_and_written_through_their_columns) {
  std::vector<double> x{1.0, 2.0, 3.0};
  std::vector<double> y{10.0, 20.0, 30.0};
  const Columns<2, double> columns(std::array<std::span<double>, 2>{x, y});
  BOOST_TEST(columns.size() == 3u);
  BOOST_TEST((columns[1] == Vec<2>{2.0, 20.0}));
  columns.set(1, {5.0, 6.0});
  columns.add(2, {0.5, 0.25});
  BOOST_TEST((x == std::vector<double>{1.0, 5.0, 3.5}));
  BOOST_TEST((y == std::vector<double>{10.0, 6.0, 30.25}));
  BOOST_TEST(columns.column(1).data() == y.data());
  const Columns<2, const double> view = columns;
  BOOST_TEST((view[2] == Vec<2>{3.5, 30.25}));
}

BOOST_AUTO_TEST_CASE(scalars_are_one_column) {
  std::vector<float> values{1.0f, 2.0f};
  const Columns<1, float> columns{std::span<float>(values)};
  columns.set(0, {3.0f});
  BOOST_TEST(values[0] == 3.0f);
  BOOST_TEST((columns[1] == Vec<1, float>{2.0f}));
}

BOOST_AUTO_TEST_CASE(reading_takes_arrays_spans_and_columns) {
  std::vector<double> values{1.0, 2.0};
  const auto from_array = read_columns(values);
  const auto from_span = read_columns(std::span<double>(values));
  const auto from_const = read_columns(std::as_const(values));
  const auto from_columns = read_columns(Columns<1, double>{std::span<double>(values)});
  static_assert(std::is_same_v<decltype(from_array), const Columns<1, const double>>);
  static_assert(std::is_same_v<decltype(from_span), const Columns<1, const double>>);
  static_assert(std::is_same_v<decltype(from_const), const Columns<1, const double>>);
  static_assert(std::is_same_v<decltype(from_columns), const Columns<1, const double>>);
  for (const auto& columns : {from_array, from_span, from_const, from_columns}) {
    BOOST_TEST(columns.size() == 2u);
    BOOST_TEST(columns.column(0).data() == values.data());
  }
}

BOOST_AUTO_TEST_CASE(unequal_lengths_are_refused) {
  std::vector<double> x(3), y(4);
  using Spans = std::array<std::span<double>, 2>;
  BOOST_CHECK_EXCEPTION((Columns<2, double>(Spans{x, y})), SizeError, [](const Error& error) {
    return std::string(error.what()).find("a component array has 4 entries where 3 are needed") != std::string::npos;
  });
}
