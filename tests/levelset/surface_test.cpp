// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE surface
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <levelset/as_given.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <support/order.hpp>
#include <tuple>

#include <cambium/levelset/cell_moments.hpp>
#include <cambium/levelset/surface.hpp>

using namespace cambium;
using std::numbers::pi;
using support::AsGiven;

namespace {

template <int D>
using Dimension = std::integral_constant<int, D>;
using Dimensions = std::tuple<Dimension<2>, Dimension<3>>;
template <int D>
using Formula = std::function<double(const Vec<D>&)>;

template <int D>
NarrowBand<double, D> band_of(std::ptrdiff_t cells, const std::type_identity_t<Formula<D>>& f) {
  const Box<D> box{Vec<D>::constant(-6.0), Vec<D>::constant(6.0)};
  return LevelSet<AsGiven, D>(Lattice<D>::bounded_box(box, cells), f).band();
}
/// How often every side (an end of a segment, an edge of a triangle) is run through forwards minus backwards, and in
/// all.
template <int D>
std::map<std::array<std::uint32_t, D - 1>, std::array<int, 2>> sides(const Surface<D>& surface) {
  std::map<std::array<std::uint32_t, D - 1>, std::array<int, 2>> result;
  for (const auto& element : surface.elements) {
    for (int k = 0; k < D; ++k) {
      std::array<std::uint32_t, D - 1> side;
      int way = D == 2 && k == 0 ? -1 : 1;
      for (int c = 0; c + 1 < D; ++c) side[c] = element[(k + c) % D];
      if (!std::is_sorted(side.begin(), side.end())) way = -way;
      std::sort(side.begin(), side.end());
      result[side][0] += way;
      ++result[side][1];
    }
  }
  return result;
}
template <int D>
bool is_closed(const Surface<D>& surface) {
  const auto all = sides(surface);
  return std::all_of(all.begin(), all.end(), [](const auto& s) { return s.second == std::array<int, 2>{0, 2}; });
}
std::ptrdiff_t euler_characteristic(const Surface<3>& surface) {
  return static_cast<std::ptrdiff_t>(surface.vertices.size() + surface.elements.size()) -
         static_cast<std::ptrdiff_t>(sides(surface).size());
}
template <int D>
double ball(const Vec<D>& x) {
  return norm(x - Vec<D>::constant(0.0321)) - 2.0;
}
/// Greatest distance of a vertex, and greatest angle of a normal, to those of the ball.
template <int D>
Vec<2> errors(std::ptrdiff_t cells, bool projected) {
  const auto surface = extract_surface(band_of<D>(cells, ball<D>), {projected});
  Vec<2> worst{};
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    const Vec<D> n = surface.vertices[v] - Vec<D>::constant(0.0321);
    worst[0] = std::max(worst[0], std::abs(ball(surface.vertices[v])));
    worst[1] = std::max(worst[1], norm(surface.normals[v] - n / norm(n)));
  }
  return worst;
}

}  // namespace

/// Order 5 of the kernel in distance (4 in normals), 2 of straight lines.
BOOST_AUTO_TEST_CASE_TEMPLATE(vertices_are_on_the_interface, Dim, Dimensions) {
  constexpr int D = Dim::value;
  const Vec<2> coarse = errors<D>(32, true), fine = errors<D>(64, true);
  BOOST_TEST_INFO(coarse << fine);
  BOOST_TEST(support::observed_order(coarse[0], fine[0]) > 4.2);
  BOOST_TEST(support::observed_order(coarse[1], fine[1]) > 3.3);
  const double order = support::observed_order(errors<D>(32, false)[0], errors<D>(64, false)[0]);
  BOOST_TEST(order > 1.7);
  BOOST_TEST(order < 2.6);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(balls_are_closed_and_turned_outwards, Dim, Dimensions) {
  constexpr int D = Dim::value;
  const auto surface = extract_surface(band_of<D>(32, ball<D>));
  BOOST_TEST(is_closed(surface));
  for (const auto& element : surface.elements) {
    std::array<Vec<D>, D> corners;
    for (int c = 0; c < D; ++c) corners[c] = surface.vertices[element[c]];
    const Vec<D> area = detail::area_vector<D>(corners);
    for (int c = 0; c < D; ++c) BOOST_REQUIRE(dot(area, surface.normals[element[c]]) >= 0.9 * norm(area));
  }
}

BOOST_AUTO_TEST_CASE(euler_characteristics) {
  BOOST_TEST(euler_characteristic(extract_surface(band_of<3>(32, ball<3>))) == 2);
  const auto torus = extract_surface(
      band_of<3>(48, [](const Vec<3>& x) { return std::hypot(std::hypot(x[0], x[1]) - 3.0, x[2] - 0.1) - 1.2; }));
  BOOST_TEST(euler_characteristic(torus) == 0);
  BOOST_TEST(is_closed(torus));
  const auto two = extract_surface(band_of<3>(48, [](const Vec<3>& x) {
    return std::min(ball(x), norm(x - Vec<3>{4, 0, 0}) - 1.0);
  }));
  BOOST_TEST(euler_characteristic(two) == 4);
}

BOOST_AUTO_TEST_CASE(curvature_of_an_ellipsoid_at_its_poles) {
  const auto surface = extract_surface(band_of<3>(64, [](const Vec<3>& x) {
    return norm(Vec<3>{1.3 * x[0], x[1], 0.7 * x[2]}) - 2.0;
  }));
  const double expected[3] = {0.57307692307692, 1.09, 1.9214285714286};
  for (int axis = 0; axis < 3; ++axis) {
    std::size_t pole = 0;
    for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
      if (surface.vertices[v][axis] > surface.vertices[pole][axis]) pole = v;
    }
    BOOST_TEST(std::abs(surface.curvatures[pole] / expected[axis] - 1.0) < 1e-3);  // third order; measured 3e-4
  }
}

BOOST_AUTO_TEST_CASE(curves_run_around_the_inside) {
  const auto surface = extract_surface(band_of<2>(64, [](const Vec<2>& x) { return std::abs(norm(x) - 3.0) - 1.0; }));
  const auto curves = closed_curves(surface);
  BOOST_REQUIRE(curves.size() == 2u);
  for (const auto& curve : curves) {
    double area = 0.0;
    for (std::size_t k = 0; k < curve.size(); ++k) {
      const Vec<2>& a = surface.vertices[curve[k]];
      const Vec<2>& b = surface.vertices[curve[(k + 1) % curve.size()]];
      area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    // Anticlockwise outside, clockwise around the hole; polygons miss a part h^2 / 6 R^2.
    BOOST_TEST(std::abs(area / ((area < 0.0 ? -4.0 : 16.0) * pi) - 1.0) < 5e-3);
  }
}

/// Closed even where every other face is ambiguous, loops need a vertex in the middle, and the box is periodic.
BOOST_AUTO_TEST_CASE_TEMPLATE(noise_is_closed, Dim, Dimensions) {
  constexpr int D = Dim::value;
  const auto lattice = Lattice<D>::periodic_box(Box<D>::cube(20.0), 20);  // its last blocks are thin
  const auto noise = [&](const Vec<D>& x) {
    double phase = 0.3;
    for (int d = 0; d < D; ++d) phase += (12.9898 + 65.234 * d) * std::round(std::fmod(x[d], 20.0));
    return std::fmod(43758.5453 * (1.0 + std::sin(phase)), 1.0) - 0.5;
  };
  const LevelSet<AsGiven, D> level_set(lattice, Formula<D>(noise));
  const auto surface = extract_surface(level_set.band());
  BOOST_TEST(is_closed(surface));
  BOOST_TEST(surface.elements.size() > 100u);
  if constexpr (D == 3) {
    std::size_t edges = 0;
    const auto value = [&](std::size_t i) { return level_set.band()(lattice.node(i)); };
    for (std::size_t i = 0; i < lattice.size(); ++i) {
      for (int d = 0; d < 3; ++d) {
        const Index<3> next = level_set.band().inside(lattice.node(i) + Index<3>::unit(d));
        edges += (value(i) < 0.0) != (level_set.band()(next) < 0.0) ? 1u : 0u;
      }
    }
    BOOST_TEST(surface.vertices.size() > edges);  // some are in the middle of cells
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(threads_change_no_bit, Dim, Dimensions) {
  constexpr int D = Dim::value;
  const auto band = band_of<D>(32, ball<D>);
  const auto one = extract_surface(band, {}, OpenMP{1});
  for (const int threads : {2, 3}) {
    const auto more = extract_surface(band, {}, OpenMP{threads});
    BOOST_TEST((more.vertices == one.vertices && more.normals == one.normals && more.elements == one.elements));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(bad_bands_are_refused, Dim, Dimensions) {
  constexpr int D = Dim::value;
  auto band = band_of<D>(32, ball<D>);
  BOOST_CHECK_THROW(extract_surface(NarrowBand<double, D>(band.lattice(), 1.0)), InterfaceError);
  band.values().set(Index<D>::constant(12), std::numeric_limits<double>::infinity());
  BOOST_CHECK_THROW(extract_surface(band), ValueError);
}
