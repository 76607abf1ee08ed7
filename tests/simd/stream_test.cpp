// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE stream
#include <boost/test/unit_test.hpp>
#include <tuple>

#include <cambium/core/aligned.hpp>
#include <cambium/simd/stream.hpp>

using namespace cambium;

// Every length and alignment around some cache lines: what is asked for is written, and nothing next to it.
BOOST_AUTO_TEST_CASE_TEMPLATE(as_copy_and_fill, T, decltype(std::tuple<float, double>())) {
  constexpr std::size_t size = 80;
  constexpr std::size_t shifts = 7;
  AlignedVector<T> from(size + shifts);
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<T>(i + 1);
  for (std::size_t begin = 0; begin < 20; ++begin) {
    for (std::size_t count = 0; begin + count < size; ++count) {
      const std::size_t shift = 3 * begin % shifts;
      AlignedVector<T> copied(size, T(0)), filled(size, T(0));
      simd::stream_copy(from.data() + shift, count, copied.data() + begin);
      simd::stream_fill(filled.data() + begin, count, T(5));
      simd::finish_streams();
      for (std::size_t i = 0; i < size; ++i) {
        const bool inside = i >= begin && i < begin + count;
        BOOST_REQUIRE(copied[i] == (inside ? from[shift + i - begin] : T(0)));
        BOOST_REQUIRE(filled[i] == (inside ? T(5) : T(0)));
      }
    }
  }
}
