// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE error
#include <boost/test/unit_test.hpp>
#include <string>

#include <cambium/core/error.hpp>

using namespace cambium;

template <class... E>
constexpr bool all_are_errors = (std::is_base_of_v<Error, E> && ...);
static_assert(all_are_errors<PositionError, ValueError, LatticeError, SizeError, AttributeError>);
static_assert(std::is_base_of_v<std::runtime_error, Error>);

BOOST_AUTO_TEST_CASE(numbers_are_written_in_full) {
  BOOST_TEST(detail::message("at ", 0.1, ", particle ", 3) == "at 0.10000000000000001, particle 3");
}

BOOST_AUTO_TEST_CASE(sizes_are_compared) {
  require_size(3, 3, "array");
  BOOST_CHECK_EXCEPTION(require_size(3, 4, "array of strengths"), SizeError, [](const Error& error) {
    return std::string(error.what()) ==
           "array of strengths has 3 entries where 4 are needed: give every array of one call the same length";
  });
}
