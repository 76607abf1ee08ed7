// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE transpose
#include <boost/test/unit_test.hpp>
#include <tuple>
#include <type_traits>

#include <cambium/core/aligned.hpp>
#include <cambium/simd/transpose.hpp>

using namespace cambium;

template <class T, std::size_t L>
struct Square {
  using Scalar = T;
  static constexpr std::size_t size = L;
};
using Squares =
    std::tuple<Square<double, 1>, Square<double, 4>, Square<double, 8>, Square<float, 4>, Square<float, 16>>;

BOOST_AUTO_TEST_CASE_TEMPLATE(rows_become_columns, S, Squares) {
  using T = typename S::Scalar;
  constexpr std::size_t L = S::size;
  constexpr std::size_t from_pitch = L + 3, to_pitch = 32;
  AlignedVector<T> from(L * from_pitch);
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<T>(i + 1);
  for (const bool stream : {false, true}) {
    for (const std::size_t offset : {0, 1}) {  // the first can be streamed to, the second not
      AlignedVector<T> to(L * to_pitch, T(0));
      simd::transpose<L>(from.data(), from_pitch, to.data() + offset, to_pitch, stream);
      simd::finish_streams();
      for (std::size_t j = 0; j < L; ++j) {
        for (std::size_t i = 0; i < to_pitch - offset; ++i) {
          BOOST_REQUIRE(to[offset + j * to_pitch + i] == (i < L ? from[i * from_pitch + j] : T(0)));
        }
        BOOST_REQUIRE((offset == 0 || to[j * to_pitch] == T(0)));
      }
    }
  }
}
