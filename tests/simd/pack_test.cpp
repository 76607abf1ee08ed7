// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE pack
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numeric>
#include <tuple>

#include <cambium/simd/pack.hpp>

using namespace cambium::simd;

namespace {

/// Numbers of both signs, whole and not, some alike in `a` and `b`.
template <class T, std::size_t N>
struct Numbers {
  alignas(64) T a[N], b[N], c[N];
  Numbers() {
    for (std::size_t l = 0; l < N; ++l) {
      const auto k = static_cast<T>(l);
      a[l] = T(0.75) * k - T(2.5);
      b[l] = l % 3 == 0 ? a[l] : T(1.5) - T(0.3) * k;
      c[l] = k * k - T(7);
    }
  }
};

template <class T, std::size_t N>
bool holds(const Pack<T, N>& pack, const T* expected) {
  alignas(64) T lane[N];
  pack.store_aligned(lane);
  return std::equal(lane, lane + N, expected);
}

/// Holds an operation on packs against the same on scalars, bit by bit.
template <class T, std::size_t N, class OnPacks, class OnScalars>
void check(const char* what, OnPacks&& on_packs, OnScalars&& on_scalars) {
  const Numbers<T, N> x;
  using V = Pack<T, N>;
  T expected[N];
  for (std::size_t l = 0; l < N; ++l) expected[l] = on_scalars(x.a[l], x.b[l], x.c[l]);
  BOOST_TEST(holds(on_packs(V::load_aligned(x.a), V::load_aligned(x.b), V::load_aligned(x.c)), expected),
             what << ", " << N << " lanes");
}

template <class T, std::size_t N>
struct Case {
  using Scalar = T;
  static constexpr std::size_t lanes = N;
};
using Cases = std::tuple<Case<float, 1>, Case<float, 2>, Case<float, 4>, Case<float, 8>, Case<float, 16>,
                         Case<double, 1>, Case<double, 2>, Case<double, 4>, Case<double, 8>, Case<double, 16>>;

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(shape, C, Cases) {
  using V = Pack<typename C::Scalar, C::lanes>;
  static_assert(V::lanes == C::lanes && V::width * V::count == V::lanes && V::alignment <= 64);
  static_assert(native_lanes<typename C::Scalar> >= 4);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(loads_and_stores, C, Cases) {
  using T = typename C::Scalar;
  constexpr std::size_t N = C::lanes;
  using V = Pack<T, N>;
  alignas(64) T from[N + 2], to[N + 2];
  std::iota(from, from + N + 2, T(1));
  std::fill(to, to + N + 2, T(-1));
  V::load(from + 1).store(to + 1);  // not aligned, and nothing beyond
  BOOST_TEST((to[0] == T(-1) && to[N + 1] == T(-1)));
  BOOST_TEST(std::equal(from + 1, from + N + 1, to + 1));
  BOOST_TEST(holds(V::load(from + 1), from + 1));
  BOOST_TEST(holds(V::load_aligned(from), from));
  std::fill(to, to + N, T(2.5));
  BOOST_TEST(holds(V(T(2.5)), to));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(arithmetic, C, Cases) {
  using T = typename C::Scalar;
  constexpr std::size_t N = C::lanes;
  const auto check_it = [](const char* what, auto&& f) { check<T, N>(what, f, f); };
  check_it("+", [](const auto& a, const auto& b, const auto&) { return a + b; });
  check_it("-", [](const auto& a, const auto& b, const auto&) { return a - b; });
  check_it("*", [](const auto& a, const auto& b, const auto&) { return a * b; });
  check_it("/", [](const auto& a, const auto&, const auto& c) { return a / c; });
  using V = Pack<T, N>;
  check<T, N>(
      "floor", [](const V& a, const V&, const V&) { return floor(a); }, [](T a, T, T) { return std::floor(a); });
  check<T, N>(
      "min", [](const V& a, const V& b, const V&) { return min(a, b); }, [](T a, T b, T) { return std::min(a, b); });
  check<T, N>(
      "max", [](const V& a, const V& b, const V&) { return max(a, b); }, [](T a, T b, T) { return std::max(a, b); });
  check<T, N>(
      "where_equal", [](const V& a, const V& b, const V& c) { return where_equal(a, b, c, a); },
      [](T a, T b, T c) { return a == b ? c : a; });
}

// One rounding or two, as the machine has it: the lanes are near the exact value in either case.
BOOST_AUTO_TEST_CASE_TEMPLATE(fused_multiply_add, C, Cases) {
  using T = typename C::Scalar;
  constexpr std::size_t N = C::lanes;
  using V = Pack<T, N>;
  const Numbers<T, N> x;
  T lane[N];
  fma(V::load_aligned(x.a), V::load_aligned(x.b), V::load_aligned(x.c)).store(lane);
  for (std::size_t l = 0; l < N; ++l) {
    const T size = std::abs(x.a[l] * x.b[l]) + std::abs(x.c[l]);
    BOOST_TEST(std::abs(lane[l] - std::fma(x.a[l], x.b[l], x.c[l])) <= size * std::numeric_limits<T>::epsilon());
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(across_lanes, C, Cases) {
  using T = typename C::Scalar;
  constexpr std::size_t N = C::lanes;
  using V = Pack<T, N>;
  Numbers<T, N> x;
  const V a = V::load_aligned(x.a);
  BOOST_TEST(sum(a) == std::accumulate(x.a, x.a + N, T(0)));  // quarters: exact in any order
  BOOST_TEST(lowest_lane(a) == *std::min_element(x.a, x.a + N));
  BOOST_TEST(lowest_lane(V(T(0)) - a) == -*std::max_element(x.a, x.a + N));
  BOOST_TEST(all_equal(a, a));
  for (std::size_t l = 0; l < N; ++l) {  // every lane counts
    Numbers<T, N> y;
    y.a[l] += T(1);
    BOOST_TEST(!all_equal(a, V::load_aligned(y.a)));
    BOOST_TEST(sum(V::load_aligned(y.a)) == sum(a) + T(1));
    y.a[l] = T(-100);
    BOOST_TEST(lowest_lane(V::load_aligned(y.a)) == T(-100));
  }
}

BOOST_AUTO_TEST_CASE(a_pointer_stays_the_pointer) {
  double value = 3.0;
  BOOST_TEST(keep_in_register(&value) == &value);
}
