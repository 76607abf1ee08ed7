// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE symmetric_difference
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <levelset/as_given.hpp>
#include <limits>
#include <numbers>
#include <tuple>

#include <cambium/levelset/symmetric_difference.hpp>

using namespace cambium;
using std::numbers::pi;
using support::AsGiven;

namespace {

template <int D, class S>
struct Case {
  static constexpr int dimension = D;
  using Scalar = S;
};
using Cases = std::tuple<Case<2, double>, Case<3, double>, Case<3, float>>;
template <int D>
using Formula = std::function<double(const Vec<D>&)>;

constexpr double radius = 2.0;

template <int D>
double volume() {
  return D == 2 ? pi * radius * radius : 4.0 / 3.0 * pi * std::pow(radius, 3);
}
template <int D>
double area() {
  return D * volume<D>() / radius;
}
/// Volume that two balls at a distance have in common.
template <int D>
double lens(double distance) {
  const double half = 0.5 * distance;
  if (D == 2)
    return 2.0 * (radius * radius * std::acos(half / radius) - half * std::sqrt(radius * radius - half * half));
  return pi * (4.0 * radius + distance) * std::pow(2.0 * radius - distance, 2) / 12.0;
}
template <int D>
Vec<D> centre() {
  return Vec<D>::constant(0.123);
}
template <int D, class T>
NarrowBand<T, D> ball_band(std::ptrdiff_t cells) {
  const Box<D> box{Vec<D>::constant(-6.0), Vec<D>::constant(6.0)};
  const Formula<D> f = [](const Vec<D>& x) { return norm(x - centre<D>()) - radius; };
  return LevelSet<AsGiven, D, T>(Lattice<D>::bounded_box(box, cells), f).band();
}
/// A ball moved aside, not as a distance.
template <int D>
Formula<D> moved_ball(double by) {
  Vec<D> way;
  for (int d = 0; d < D; ++d) way[d] = d + 1.0;
  const Vec<D> at = centre<D>() + way * (by / norm(way));
  return [at](const Vec<D>& x) { return dot(x - at, x - at) - radius * radius; };
}

}  // namespace

/// The accuracy that is promised: 1e-3 spacings times the area, from a thousandth of a spacing to many.
BOOST_AUTO_TEST_CASE_TEMPLATE(moved_balls, C, Cases) {
  constexpr int D = C::dimension;
  const auto band = ball_band<D, typename C::Scalar>(32);
  const double scale = band.spacing() * area<D>();
  for (const double by : {0.001, 0.01, 0.1, 0.37, 1.0, 5.0}) {
    const double exact = 2.0 * (volume<D>() - lens<D>(by * band.spacing()));
    const double found = symmetric_difference(band, moved_ball<D>(by * band.spacing()));
    BOOST_TEST_INFO("D = " << D << ", moved by " << by << " spacings");
    BOOST_TEST(std::abs(found - exact) < 1e-3 * scale);
  }
}

/// With lines close together what remains is the error of the band's interpolant.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_shape_differs_little_from_itself, C, Cases) {
  constexpr int D = C::dimension;
  double error[2];
  for (int level = 0; level < 2; ++level) {
    const auto band = ball_band<D, typename C::Scalar>(32 << level);
    error[level] = symmetric_difference(band, moved_ball<D>(0.0), {4}) / (band.spacing() * area<D>());
  }
  BOOST_TEST_INFO(error[0] << ' ' << error[1]);
  BOOST_TEST(error[0] < 1e-4);
  BOOST_TEST(error[0] > 12.0 * error[1]);  // fifth order of the interpolant, fourth in spacings
}

/// Where the band has no blocks, and cells lie wholly in one of both.
BOOST_AUTO_TEST_CASE_TEMPLATE(shapes_far_apart, C, Cases) {
  constexpr int D = C::dimension;
  const auto band = ball_band<D, typename C::Scalar>(64);
  const Formula<D> other = [](const Vec<D>& x) { return norm(x + Vec<D>::constant(4.0)) - 1.0; };
  const double both = volume<D>() * (1.0 + std::pow(1.0 / radius, D));
  BOOST_TEST(std::abs(symmetric_difference(band, other) - both) < 1e-3 * band.spacing() * area<D>());
  const Formula<D> everywhere = [](const Vec<D>&) { return -1.0; };
  const double rest = std::pow(12.0, D) - volume<D>();
  BOOST_TEST(std::abs(symmetric_difference(band, everywhere) - rest) < 1e-3 * band.spacing() * area<D>());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(threads_change_no_bit, C, Cases) {
  constexpr int D = C::dimension;
  const auto band = ball_band<D, typename C::Scalar>(32);
  const double one = symmetric_difference(band, moved_ball<D>(0.2), {}, OpenMP{1});
  BOOST_TEST(symmetric_difference(band, moved_ball<D>(0.2), {}, OpenMP{2}) == one);
  BOOST_TEST(symmetric_difference(band, moved_ball<D>(0.2), {}, OpenMP{3}) == one);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(bad_input_is_refused, C, Cases) {
  constexpr int D = C::dimension;
  using T = typename C::Scalar;
  auto band = ball_band<D, T>(32);
  BOOST_CHECK_THROW(symmetric_difference(NarrowBand<T, D>(band.lattice(), 1.0), moved_ball<D>(0.0)), InterfaceError);
  BOOST_CHECK_THROW(symmetric_difference(band, moved_ball<D>(0.0), {0}), ValueError);
  const Formula<D> nowhere = [](const Vec<D>&) { return std::numeric_limits<double>::quiet_NaN(); };
  BOOST_CHECK_THROW(symmetric_difference(band, nowhere), ValueError);
  band.values().set(Index<D>::constant(12), std::numeric_limits<T>::quiet_NaN());
  BOOST_CHECK_THROW(symmetric_difference(band, moved_ball<D>(0.0)), ValueError);
}
