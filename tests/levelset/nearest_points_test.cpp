// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE nearest_points
#include <boost/test/unit_test.hpp>
#include <random>
#include <tuple>

#include <cambium/levelset/nearest_points.hpp>
#include <cambium/levelset/point_box.hpp>

using namespace cambium;

namespace {

template <class T, int D_>
struct Case {
  using Scalar = T;
  static constexpr int D = D_;
};
using Cases = std::tuple<Case<double, 2>, Case<double, 3>, Case<float, 3>>;

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_looking_at_all, C, Cases) {
  constexpr int D = C::D;
  using T = typename C::Scalar;
  constexpr auto extent = static_cast<T>(BlockShape<D>::extent);
  std::mt19937 random(7);
  std::uniform_real_distribution<T> anywhere(T(-8), extent + T(8));
  detail::NearestPoints<T, D, std::size_t> nearest;
  for (const std::size_t count : {0u, 1u, 7u, 8u, 9u, 60u, 400u}) {
    const T width = count % 2 == 0 ? T(6.3) : T(2.5);
    std::vector<Vec<D, T>> points(count);
    nearest.reset(width);
    for (std::size_t p = 0; p < count; ++p) {
      for (int d = 0; d < D; ++d) points[p][d] = anywhere(random);
      nearest.offer(points[p], 10 * p);
    }
    nearest.settle();
    for (std::size_t i = 0; i < nearest.volume; ++i) {
      const Vec<D, T> x = detail::position_in_block<T, D>(i);
      T least = width;
      for (const Vec<D, T>& point : points) least = std::min(least, norm(point - x));
      BOOST_REQUIRE(nearest.found(i) == (least < width));
      if (!nearest.found(i)) continue;
      // Squares up to 40 in single precision: 4e-6.
      BOOST_REQUIRE(norm(nearest.point(i) - x) - least < T(1e-5));
      BOOST_REQUIRE(points[nearest.source(i) / 10] == nearest.point(i));
    }
  }
}
