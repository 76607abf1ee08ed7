// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#define BOOST_TEST_MODULE levelset_shapes
#include <boost/test/unit_test.hpp>
#include <support/surface_samples.hpp>
#include <tuple>

#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/levelset/shapes/cuboid.hpp>
#include <cambium/levelset/shapes/cylinder.hpp>
#include <cambium/levelset/shapes/dumbbell.hpp>
#include <cambium/levelset/shapes/ellipsoid.hpp>
#include <cambium/levelset/shapes/half_space.hpp>
#include <cambium/levelset/shapes/torus.hpp>
#include <cambium/levelset/shapes/zalesak_disk.hpp>

using namespace cambium;

namespace {

constexpr double pi = std::numbers::pi;
using Dimensions = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

template <int D>
Vec<D> point(double a, double b, double c) {
  if constexpr (D == 2) {
    (void)c;
    return {a, b};
  } else {
    return {a, b, c};
  }
}

template <int D>
Box<D> around(Box<D> box) {
  for (int d = 0; d < D; ++d) {
    const double margin = 0.4 * box.extent()[d];
    box.lo[d] -= margin;
    box.hi[d] += margin;
  }
  return box;
}

/// Holds |shape| against the closest of points on its surface and its sign against `inside`. A sample within s of the
/// closest point is at most sqrt(d^2 + s^2 (1 + d / R)) away, with R the smallest radius of curvature, here above d
/// / 3.
template <Shape S, class F>
void check_exact(const S& shape, const support::SurfaceSamples<S::dimension>& surface, F&& inside) {
  constexpr int D = S::dimension;
  check_shape<S>();
  int wrong = 0, wrong_sign = 0;
  for (const auto& x : support::random_points(around(shape.bounds()), 400)) {
    const double value = shape(x), sampled = surface.distance(x);
    wrong += !(sampled >= std::abs(value) - 1e-12);
    wrong += !(sampled <= std::sqrt(value * value + 4.0 * surface.spacing * surface.spacing));
    wrong_sign += (value < 0.0) != inside(x);
  }
  BOOST_TEST(wrong == 0);
  BOOST_TEST(wrong_sign == 0);
  BOOST_TEST(surface.spacing < 0.02);
  Box<D> found{surface.points[0], surface.points[0]};
  for (const auto& x : surface.points) {
    if (!(std::abs(shape(x)) < 1e-12)) BOOST_TEST(shape(x) == 0.0);
    found = cambium::detail::hull(found, {x, x});
  }
  for (int d = 0; d < D; ++d) {  // bounds are as tight as samples can tell, but for the dumbbell's neck never cut
    BOOST_TEST(std::abs(shape.bounds().lo[d] - found.lo[d]) < 0.03);
    BOOST_TEST(shape.bounds().lo[d] <= found.lo[d] + 1e-12);
    BOOST_TEST(shape.bounds().hi[d] >= found.hi[d] - 1e-12);
    BOOST_TEST(std::abs(shape.bounds().hi[d] - found.hi[d]) < 0.03);
  }
}

template <int D>
Vec<D> unit_axis() {
  const Vec<D> axis = point<D>(0.6, 0.5, -0.4);
  return axis / norm(axis);
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(ball_is_exact, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  const Vec<D> centre = point<D>(0.3, -0.2, 0.1);
  support::SurfaceSamples<D> surface;
  surface.revolve(centre, unit_axis<D>(),
                  [](double u) { return std::pair(0.4 * std::cos(pi * u), 0.4 * std::sin(pi * u)); });
  check_exact(Ball<D>(centre, 0.4), surface, [&](const Vec<D>& x) { return norm(x - centre) < 0.4; });
}

BOOST_AUTO_TEST_CASE_TEMPLATE(cylinder_is_exact_along_any_axis, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  const Vec<D> axis = unit_axis<D>(), from = point<D>(0.1, 0.2, 0.3), to = from + 0.7 * axis;
  support::SurfaceSamples<D> surface;
  surface.revolve(from, axis, [](double u) { return std::pair(0.7 * u, 0.25); });
  surface.revolve(from, axis, [](double u) { return std::pair(0.0, 0.25 * u); });
  surface.revolve(from, axis, [](double u) { return std::pair(0.7, 0.25 * u); });
  check_exact(Cylinder<D>(from, to, 0.25), surface, [&](const Vec<D>& x) {
    const double along = dot(x - from, axis);
    return along > 0.0 && along < 0.7 && norm(x - from - along * axis) < 0.25;
  });
}

BOOST_AUTO_TEST_CASE_TEMPLATE(dumbbell_is_exact, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  const Vec<D> axis = unit_axis<D>(), a = point<D>(0.1, 0.2, 0.3), b = a + 0.9 * axis;
  const double radius = 0.25, neck = 0.1, from = std::asin(neck / radius);
  support::SurfaceSamples<D> surface;
  for (const double way : {-1.0, 1.0}) {
    surface.revolve(way < 0.0 ? a : b, axis, [&](double u) {
      const double angle = (pi - from) * u;
      return std::pair(way * radius * std::cos(angle), radius * std::sin(angle));
    });
  }
  const double junction = radius * std::cos(from);
  surface.revolve(a, axis, [&](double u) { return std::pair(junction + (0.9 - 2.0 * junction) * u, neck); });
  check_exact(Dumbbell<D>(a, b, radius, neck), surface, [&](const Vec<D>& x) {
    const double along = dot(x - a, axis);
    const bool in_neck = along > 0.0 && along < 0.9 && norm(x - a - along * axis) < neck;
    return norm(x - a) < radius || norm(x - b) < radius || in_neck;
  });
}

BOOST_AUTO_TEST_CASE(torus_is_exact_around_any_axis) {
  const Vec<3> axis = unit_axis<3>(), centre{0.2, 0.1, 0.3};
  support::SurfaceSamples<3> surface;
  surface.revolve(centre, axis, [](double u) {
    return std::pair(0.15 * std::sin(2.0 * pi * u), 0.4 + 0.15 * std::cos(2.0 * pi * u));
  });
  check_exact(Torus(centre, 0.4, 0.15, 3.0 * axis), surface, [&](const Vec<3>& x) {
    const double along = dot(x - centre, axis);
    return std::pow(norm(x - centre - along * axis) - 0.4, 2) + along * along < 0.15 * 0.15;
  });
}

BOOST_AUTO_TEST_CASE_TEMPLATE(cuboid_is_exact, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  const Box<D> box{point<D>(-0.1, 0.2, 0.3), point<D>(0.5, 0.5, 1.1)};
  support::SurfaceSamples<D> surface;
  for (int axis = 0; axis < D; ++axis) {
    for (const double side : {box.lo[axis], box.hi[axis]}) {
      const auto face = [&](double u, double v) {
        Vec<D> x = Vec<D>::unit(axis, side);
        const int a = (axis + 1) % D, b = (axis + 2) % D;
        x[a] = box.lo[a] + u * box.extent()[a];
        if (D == 3) x[b] = box.lo[b] + v * box.extent()[b];
        return x;
      };
      surface.add(face, D == 2 ? 3000 : 150, D == 2 ? 0 : 150);
    }
  }
  check_exact(Cuboid<D>(box), surface, [&](const Vec<D>& x) { return box.contains(x); });
}

BOOST_AUTO_TEST_CASE(zalesak_disk_is_exact) {
  const Vec<2> centre{0.5, 0.75};
  const double radius = 0.15, half = 0.025, top = 0.1, mouth = -std::sqrt(radius * radius - half * half);
  const double from = std::asin(half / radius);
  support::SurfaceSamples<2> surface;
  // Around the vertical line through the centre, from the lowest point up: the arc, the side of the slot, its end.
  const Vec<2> up{0.0, 1.0};
  surface.revolve(centre, up, [&](double u) {
    const double angle = (pi - from) * u;
    return std::pair(radius * std::cos(angle), radius * std::sin(angle));
  });
  surface.revolve(centre, up, [&](double u) { return std::pair(mouth + (top - mouth) * u, half); });
  surface.revolve(centre, up, [&](double u) { return std::pair(top, half * u); });
  check_exact(ZalesakDisk(centre, radius, 0.05, 0.25), surface, [&](const Vec<2>& x) {
    const Vec<2> p = x - centre;
    return norm(p) < radius && !(std::abs(p[0]) < half && p[1] < top);
  });
}

BOOST_AUTO_TEST_CASE_TEMPLATE(planes_are_exact, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  const Vec<D> normal = unit_axis<D>(), at = point<D>(0.1, 0.2, 0.3);
  const HalfSpace<D> half_space(at, 5.0 * normal);
  const Slab<D> slab(at, 0.1 * normal, 0.2);
  check_shape<HalfSpace<D>>();
  check_shape<Slab<D>>();
  for (const double height : {-0.3, -0.05, 0.0, 0.05, 0.3}) {
    const Vec<D> x = at + height * normal;
    BOOST_TEST(std::abs(half_space(x) - height) < 1e-15);
    BOOST_TEST(std::abs(slab(x) - (std::abs(height) - 0.1)) < 1e-15);
  }
}

// Below the distance, zero on the surface, and between min(a) / max(a) of the distance and the distance near it.
BOOST_AUTO_TEST_CASE_TEMPLATE(ellipsoid_bounds_the_distance_from_below, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  const Vec<D> centre = point<D>(0.3, -0.2, 0.1), half = point<D>(0.4, 0.2, 0.3);
  const Ellipsoid<D> ellipsoid(centre, half);
  check_shape<Ellipsoid<D>>();
  support::SurfaceSamples<D> surface;
  surface.revolve({}, Vec<D>::unit(0), [](double u) { return std::pair(std::cos(pi * u), std::sin(pi * u)); });
  for (auto& x : surface.points) {
    for (int d = 0; d < D; ++d) x[d] = centre[d] + half[d] * x[d];
    if (!(std::abs(ellipsoid(x)) < 1e-12)) BOOST_TEST(ellipsoid(x) == 0.0);
  }
  for (const auto& x : support::random_points(around(ellipsoid.bounds()), 300)) {
    double scaled = 0.0;
    for (int d = 0; d < D; ++d) scaled += std::pow((x[d] - centre[d]) / half[d], 2);
    const double distance = surface.distance(x);
    if ((ellipsoid(x) < 0.0) != (scaled < 1.0)) BOOST_TEST(ellipsoid(x) == scaled - 1.0);
    if (std::abs(ellipsoid(x)) > distance) BOOST_TEST(ellipsoid(x) == distance);
    if (ellipsoid(x) > 0.0 && ellipsoid(x) < 0.5 * distance - 0.01) BOOST_TEST(ellipsoid(x) == 0.5 * distance);
  }
}

BOOST_AUTO_TEST_CASE(what_is_no_shape_is_an_error) {
  const double nan = std::nan("");
  BOOST_CHECK_EXCEPTION(Ball<3>({}, 0.0), ValueError,
                        [](const Error& e) { return std::string(e.what()).find("radius of the ball is 0") == 0; });
  BOOST_CHECK_THROW(Ball<2>({}, -1.0), ValueError);
  BOOST_CHECK_THROW(Ball<2>({nan, 0.0}, 1.0), ValueError);
  BOOST_CHECK_THROW(Ball<2>({}, nan), ValueError);
  BOOST_CHECK_THROW(Ellipsoid<3>({}, {1.0, 0.0, 1.0}), ValueError);
  BOOST_CHECK_THROW(Cuboid<2>(Box<2>{{0.0, 0.0}, {1.0, 0.0}}), ValueError);
  BOOST_CHECK_THROW(Cylinder<3>({}, {}, 1.0), ValueError);
  BOOST_CHECK_THROW(Cylinder<3>({}, {1.0, 0.0, 0.0}, 0.0), ValueError);
  BOOST_CHECK_THROW(Torus({}, 1.0, 1.0), ValueError);
  BOOST_CHECK_THROW(Torus({}, 1.0, 0.5, {}), ValueError);
  BOOST_CHECK_THROW(Dumbbell<2>({}, {1.0, 0.0}, 0.3, 0.3), ValueError);
  BOOST_CHECK_THROW(Dumbbell<2>({}, {0.4, 0.0}, 0.3, 0.1), ValueError);
  BOOST_CHECK_THROW(Slab<2>({}, {1.0, 0.0}, 0.0), ValueError);
  BOOST_CHECK_THROW(HalfSpace<2>({}, {0.0, nan}), ValueError);
  BOOST_CHECK_THROW(ZalesakDisk({}, 1.0, 0.2, 2.0), ValueError);
  BOOST_CHECK_THROW(ZalesakDisk({}, 1.0, 2.0, 1.0), ValueError);
}
