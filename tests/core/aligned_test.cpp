// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE aligned
#include <boost/test/unit_test.hpp>
#include <cstdint>
#include <limits>
#include <new>
#include <tuple>

#include <cambium/core/aligned.hpp>

using namespace cambium;

BOOST_AUTO_TEST_CASE_TEMPLATE(arrays_start_on_a_cache_line, T,
                              decltype(std::tuple<char, float, double, long double>{})) {
  for (const std::size_t count : {1, 3, 17, 1000, 100001}) {
    AlignedVector<T> values(count, T(1));
    BOOST_TEST(reinterpret_cast<std::uintptr_t>(values.data()) % 64 == 0u);
    values.resize(2 * count + 1);
    BOOST_TEST(reinterpret_cast<std::uintptr_t>(values.data()) % 64 == 0u);
    BOOST_TEST((values[count - 1] == T(1) && values[count] == T(0)));
  }
}

BOOST_AUTO_TEST_CASE(large_arrays_start_on_a_huge_page) {
  const AlignedVector<double> values((std::size_t{4} << 20) / sizeof(double));
  BOOST_TEST(reinterpret_cast<std::uintptr_t>(values.data()) % (std::size_t{2} << 20) == 0u);
}

BOOST_AUTO_TEST_CASE(too_much_is_a_bad_allocation) {
  AlignedAllocator<double> allocator;
  const std::size_t most = std::numeric_limits<std::size_t>::max();
  BOOST_CHECK_THROW((void)allocator.allocate(most / 4), std::bad_array_new_length);  // its bytes cannot be counted
  BOOST_CHECK_THROW((void)allocator.allocate(most / 8), std::bad_array_new_length);  // wraps around to nothing
}
