// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE at_closest_points
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstring>
#include <tuple>

#include <cambium/levelset/geometry/at_closest_points.hpp>
#include <cambium/levelset/level_set.hpp>

#include "support/ellipsoid.hpp"
#include "support/order.hpp"

using namespace cambium;

static_assert(GeometryPolicy<AtClosestPoints<>> && GeometryPolicy<AtClosestPoints<Lambda<6, 4>>>);

namespace {

struct Errors {
  double normal = 0.0, mean = 0.0, gaussian = 0.0;
};

/// From the badly scaled phi of an ellipsoid through the reinitialisation, over the whole band. The exact geometry is
/// that of the quadric through the point that was found: that is off by less than the order of what is tested.
template <int D, class T = double>
Errors errors(const support::Ellipsoid<D>& ellipsoid, std::ptrdiff_t cells) {
  const auto lattice = Lattice<D>::bounded_box(Box<D>::cube(), cells);
  const LevelSet<ClosestPoint, D, T> level_set(lattice, [&](const Vec<D>& x) { return ellipsoid.badly_scaled(x); });
  typename AtClosestPoints<>::Method<T, D> method;
  BandGeometry<T, D> geometry(lattice);
  const auto& band = level_set.band();
  method(band, geometry, OpenMP{});
  Errors e;
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      BOOST_REQUIRE(geometry.defined(b, i) == method.points().found(b, i));
      if (!geometry.defined(b, i)) continue;
      Vec<D> x = lattice.position(band.values().node(b, i));
      for (int d = 0; d < D; ++d) x[d] += static_cast<double>(method.points().offset(b, i)[d]) * lattice.spacing();
      const auto exact = ellipsoid.geometry(x);
      for (int d = 0; d < D; ++d) {
        const double off = exact.normal[d] - static_cast<double>(geometry.normal.block(b)[i][d]);
        e.normal = std::max(e.normal, std::abs(off));
      }
      e.mean = std::max(e.mean, std::abs(exact.mean - static_cast<double>(geometry.mean.block(b)[i])));
      if constexpr (D == 3) {
        const auto gaussian = static_cast<double>(geometry.gaussian.block(b)[i]);
        e.gaussian = std::max(e.gaussian, std::abs(exact.gaussian - gaussian));
      }
    }
  }
  return e;
}

template <int D>
support::Ellipsoid<D> ellipsoid(double angle, const Vec<D>& shift) {
  Vec<D> semi_axes{0.3, 0.22};
  if (D == 3) semi_axes[D - 1] = 0.27;
  return {semi_axes, Vec<D>::constant(0.5) + shift, angle};
}

/// Values at the ends of the semi-axes, from the node nearest to each.
Vec<3> mean_at_axes(double e, std::ptrdiff_t cells, double angle, const Vec<3>& shift) {
  const support::Ellipsoid<3> body{{2.0 / (1.0 + e), 2.0, 2.0 / (1.0 - e)}, Vec<3>::constant(6.0) + shift, angle};
  const auto lattice = Lattice<3>::bounded_box({{0, 0, 0}, {12, 12, 12}}, cells);
  const LevelSet<> level_set(lattice, [&](const Vec<3>& x) { return std::sqrt(body(x).value + 1.0) - 1.0; });
  AtClosestPoints<>::Method<double, 3> method;
  BandGeometry<double, 3> geometry(lattice);
  method(level_set.band(), geometry, OpenMP{});
  Vec<3> result;
  for (int d = 0; d < 3; ++d) {
    // The interpolant of the curvatures of the nodes around the end, which are those of their closest points.
    const Vec<3> end = body.centre + body.semi_axes[d] * body.axis(d);
    Patch<double, 3> patch;
    Index<3> first;
    Vec<3> u;
    for (int k = 0; k < 3; ++k) {
      first[k] = static_cast<std::ptrdiff_t>(end[k] / lattice.spacing()) - 2;
      u[k] = end[k] / lattice.spacing() - static_cast<double>(first[k]);
    }
    NarrowBand<double, 3> mean = level_set.band();
    for (std::size_t b = 0; b < mean.blocks(); ++b)
      std::ranges::copy(geometry.mean.block(b), mean.values().block(b).begin());
    patch.read(mean, first, Index<3>::constant(6));
    result[d] = Interpolant<Lambda<4, 4>, double, 3>::value(patch.data(), patch.stride(), u);
  }
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE(order_on_ellipses) {
  for (const double angle : {0.0, std::numbers::pi / 6.0}) {
    const auto body = ellipsoid<2>(angle, {0.0031, -0.0017});
    const Errors coarse = errors<2>(body, 96);
    const Errors fine = errors<2>(body, 192);
    // Lambda_{4,4} reproduces degree 4: orders 4 and 3; 0.3 below is left for what the coarse lattice resolves of the
    // factor.
    BOOST_TEST(support::observed_order(coarse.normal, fine.normal) > 3.7);
    BOOST_TEST(support::observed_order(coarse.mean, fine.mean) > 2.7);
    BOOST_TEST(fine.mean < 1e-2);
  }
}

BOOST_AUTO_TEST_CASE(order_on_ellipsoids) {
  const auto body = ellipsoid<3>(std::numbers::pi / 6.0, {0.0031, -0.0017, 0.0043});
  const Errors coarse = errors<3>(body, 40);
  const Errors fine = errors<3>(body, 80);
  BOOST_TEST(support::observed_order(coarse.normal, fine.normal) > 3.5);
  BOOST_TEST(support::observed_order(coarse.mean, fine.mean) > 2.5);
  BOOST_TEST(support::observed_order(coarse.gaussian, fine.gaussian) > 2.5);
}

BOOST_AUTO_TEST_CASE(order_on_circles_and_spheres) {
  const Errors circle = errors<2>(support::Ellipsoid<2>::ball(0.25, {0.503, 0.498}), 64);
  const Errors finer_circle = errors<2>(support::Ellipsoid<2>::ball(0.25, {0.503, 0.498}), 128);
  BOOST_TEST(support::observed_order(circle.normal, finer_circle.normal) > 3.5);
  BOOST_TEST(support::observed_order(circle.mean, finer_circle.mean) > 2.5);
  const auto ball = support::Ellipsoid<3>::ball(0.25, {0.503, 0.498, 0.501});
  const Errors sphere = errors<3>(ball, 32);
  const Errors finer_sphere = errors<3>(ball, 64);
  BOOST_TEST(support::observed_order(sphere.normal, finer_sphere.normal) > 3.2);
  BOOST_TEST(support::observed_order(sphere.mean, finer_sphere.mean) > 2.2);
  BOOST_TEST(support::observed_order(sphere.gaussian, finer_sphere.gaussian) > 2.2);
}

BOOST_AUTO_TEST_CASE(ellipsoid_at_its_axes) {
  // x1^2 (1 + e)^2 + x2^2 + x3^2 (1 - e)^2 = r^2 with r = 2, e = 0.3: a / b^2 + a / c^2 and its turns.
  const Vec<3> exact{0.57307692307692, 1.09, 1.9214285714286};
  for (const double angle : {0.0, std::numbers::pi / 6.0}) {
    for (const Vec<3>& shift : {Vec<3>{}, Vec<3>{0.05, -0.08, 0.03}}) {
      const Vec<3> mean = mean_at_axes(0.3, 64, angle, shift);
      // h = 0.1875 is 0.25 of the smallest radius of curvature: h^3 times fourth derivatives leaves 1e-3 to 5e-3.
      for (int d = 0; d < 3; ++d) BOOST_TEST(mean[d] == exact[d], boost::test_tools::tolerance(5e-3));
    }
  }
}

BOOST_AUTO_TEST_CASE(constant_along_normals) {
  const auto body = ellipsoid<2>(0.3, {0.0031, -0.0017});
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 96);
  const LevelSet<ClosestPoint, 2> level_set(lattice, [&](const Vec<2>& x) { return body.badly_scaled(x); });
  AtClosestPoints<>::Method<double, 2> method;
  BandGeometry<double, 2> geometry(lattice);
  const auto& band = level_set.band();
  method(band, geometry, Serial{});
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      if (!geometry.defined(b, i)) continue;
      // The normal of the closest point is the direction to it: newton's tolerance is 1e-7 before its last, quadratic
      // step; the points themselves are right to 1e-12, over a distance of at least 0.1 h.
      const Vec<2> offset = method.points().offset(b, i);
      if (norm(offset) < 0.1) continue;
      const double sign = band.values().block(b)[i] < 0.0 ? 1.0 : -1.0;
      BOOST_REQUIRE(norm(offset / norm(offset) - sign * geometry.normal.block(b)[i]) < 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(single_precision) {
  const Errors e = errors<2, float>(ellipsoid<2>(0.0, {}), 48);
  // Round-off of phi, 1e-7 of a length 1, over h = 1/48, times weights of about 3; over h^2 and times 10.
  BOOST_TEST(e.normal < 5e-3);
  BOOST_TEST(e.mean < 0.5);
}

BOOST_AUTO_TEST_CASE(threads_do_not_change_a_bit) {
  const auto body = ellipsoid<3>(0.3, {});
  const auto lattice = Lattice<3>::bounded_box(Box<3>::cube(), 24);
  const LevelSet<> level_set(lattice, [&](const Vec<3>& x) { return body(x).value; });
  AtClosestPoints<>::Method<double, 3> method;
  BandGeometry<double, 3> serial(lattice);
  method(level_set.band(), serial, Serial{});
  for (const int threads : {1, 2, 3}) {
    BandGeometry<double, 3> other(lattice);
    method(level_set.band(), other, OpenMP{threads});
    for (std::size_t b = 0; b < level_set.band().blocks(); ++b) {
      BOOST_TEST(std::memcmp(serial.mean.block(b).data(), other.mean.block(b).data(), 512 * sizeof(double)) == 0);
    }
  }
}
