// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE by_closest_point
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstring>
#include <tuple>

#include <cambium/levelset/extension/by_closest_point.hpp>
#include <cambium/levelset/level_set.hpp>

#include "support/ellipsoid.hpp"
#include "support/order.hpp"

using namespace cambium;

static_assert(Extension<ByClosestPoint<>> && Extension<ByClosestPoint<M4Prime>> && !Extension<int>);

namespace {

template <class V, class T, int D, class F>
Field<V, D, Sparse> field_on(const NarrowBand<T, D>& band, F&& f, V background = V{}) {
  Field<V, D, Sparse> field(band.lattice(), background);
  take_blocks(field, band);
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      field.block(b)[i] = f(band.lattice().position(band.inside(field.node(b, i))));
    }
  }
  return field;
}

/// cos(2 theta) + sin(3 theta) / 2 about a centre, times a factor that depends on the radius: it varies along normals,
/// too.
template <int D>
double wave(const Vec<D>& x, const Vec<D>& centre) {
  const double theta = std::atan2(x[1] - centre[1], x[0] - centre[0]);
  const double far = D == 3 ? x[D - 1] : 0.0;
  return (std::cos(2.0 * theta) + 0.5 * std::sin(3.0 * theta) + far) * (1.0 + 3.0 * norm(x - centre));
}

template <int D>
struct Scene {
  Vec<D> centre;
  LevelSet<ClosestPoint, D> level_set;
  static constexpr double radius = 0.3;

  Scene(std::ptrdiff_t cells, const Vec<D>& at)
      : centre(at), level_set(Lattice<D>::bounded_box(Box<D>::cube(), cells), [&](const Vec<D>& x) {
          return norm(x - at) - radius;
        }) {}
  const NarrowBand<double, D>& band() const { return level_set.band(); }

  /// Largest error over the nodes within the half width; theta is singular on the axis, which the band of the upper
  /// and lower cap of a sphere meets: those are left out.
  template <class Method>
  double error(Method& method) const {
    const auto from = field_on<double>(band(), [&](const Vec<D>& x) { return wave(x, centre); });
    Field<double, D, Sparse> to(band().lattice());
    method(band(), from, to, OpenMP{});
    double error = 0.0;
    for (std::size_t b = 0; b < band().blocks(); ++b) {
      for (std::size_t i = 0; i < band().volume; ++i) {
        if (!method.points().found(b, i)) continue;
        const Vec<D> r = band().lattice().position(band().values().node(b, i)) - centre;
        const Vec<D> on_interface = radius / norm(r) * r;
        if (std::hypot(on_interface[0], on_interface[1]) < 0.22) continue;
        error = std::max(error, std::abs(to.block(b)[i] - wave(centre + on_interface, centre)));
      }
    }
    return error;
  }
};

template <class K, int D_, int Order, int Cells>
struct Case {
  using Kernel = K;
  static constexpr int D = D_;
  static constexpr int order = Order;
  static constexpr int cells = Cells;
};
using Cases = std::tuple<Case<Lambda<4, 4>, 2, 5, 96>, Case<Lambda<4, 4>, 3, 5, 48>, Case<Lambda<6, 4>, 2, 7, 64>,
                         Case<M4Prime, 2, 3, 96>>;

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(order, C, Cases) {
  constexpr int D = C::D;
  const Vec<D> centre = Vec<D>::constant(0.5) + Vec<D>::unit(0, 0.0031) - Vec<D>::unit(1, 0.0017);
  typename ByClosestPoint<typename C::Kernel>::template Method<double, D> method;
  const double coarse = Scene<D>(C::cells, centre).error(method);
  const double fine = Scene<D>(2 * C::cells, centre).error(method);
  // The point is the default kernel's (order 5), the value its own kernel's: the points of M4' and of Lambda_{6,4}
  // come from a distance of order 5 that kernel interpolates. 0.4: the third harmonic has 4 R / h points only.
  const double expected = std::min(C::order, 5) - 0.4;
  BOOST_TEST(support::observed_order(coarse, fine) > expected);
}

BOOST_AUTO_TEST_CASE(normal_derivative_vanishes) {
  // Lines through the centre of a circle: nodes on the lines along the axes and the diagonals have one closest point.
  const Vec<2> centre{0.5, 0.5};
  const Scene<2> scene(64, centre);
  const auto from = field_on<double>(scene.band(), [&](const Vec<2>& x) { return wave(x, centre); });
  Field<double, 2, Sparse> to(scene.band().lattice());
  ByClosestPoint<>::Method<double, 2> method;
  method(scene.band(), from, to, Serial{});
  for (const Index<2>& step : {Index<2>{1, 0}, Index<2>{0, -1}, Index<2>{1, 1}, Index<2>{-1, 1}}) {
    const int on_front = static_cast<int>(std::lround(0.3 * 64 / std::sqrt(static_cast<double>(dot(step, step)))));
    const double value = to(Index<2>{32, 32} + on_front * step);
    // |f| < 3, |f'| < 20 over a closest point good to 1e-12.
    for (int k = -3; k <= 3; ++k) BOOST_TEST(std::abs(to(Index<2>{32, 32} + (on_front + k) * step) - value) < 1e-10);
  }
  // Everywhere else: the value at a point is that at its closest point, so that a second extension of `to` changes it
  // by its own interpolation error alone, and that of a field that is constant along normals is small.
  Field<double, 2, Sparse> again(scene.band().lattice());
  method(scene.band(), method.points(), to, again, Serial{});
  double change = 0.0;
  for (std::size_t b = 0; b < to.blocks(); ++b) {
    for (std::size_t i = 0; i < scene.band().volume; ++i) {
      if (method.points().found(b, i)) change = std::max(change, std::abs(again.block(b)[i] - to.block(b)[i]));
    }
  }
  BOOST_TEST(change < 1e-3);
}

BOOST_AUTO_TEST_CASE(shifted_and_rotated) {
  // A shape and a field moved together: the same error against the exact values at the points of the interface.
  const auto error = [](const Vec<2>& shift, double angle) {
    const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 80);
    const support::Ellipsoid<2> body{{0.25, 0.2}, Vec<2>{0.5, 0.5} + shift, angle};
    const auto exact = [&](const Vec<2>& x) {
      return wave(Vec<2>{dot(x - body.centre, body.axis(0)), dot(x - body.centre, body.axis(1))}, {});
    };
    const LevelSet<ClosestPoint, 2> level_set(lattice, [&](const Vec<2>& x) { return body(x).value; });
    const auto from = field_on<double>(level_set.band(), exact);
    Field<double, 2, Sparse> to(lattice);
    ByClosestPoint<>::Method<double, 2> method;
    method(level_set.band(), from, to, Serial{});
    double largest = 0.0;
    for (std::size_t b = 0; b < to.blocks(); ++b) {
      for (std::size_t i = 0; i < level_set.band().volume; ++i) {
        if (!method.points().found(b, i)) continue;
        const Vec<2> x = lattice.position(to.node(b, i)) + lattice.spacing() * method.points().offset(b, i);
        largest = std::max(largest, std::abs(to.block(b)[i] - exact(x)));
      }
    }
    return largest;
  };
  const double at_rest = error({}, 0.0);
  BOOST_TEST(at_rest < 2e-4);
  BOOST_TEST(std::abs(error({4.0 / 80.0, -3.0 / 80.0}, 0.0) - at_rest) < 1e-11);  // whole nodes: round-off
  BOOST_TEST(error({0.0037, 0.0052}, 0.0) < 1.5 * at_rest);
  BOOST_TEST(error({}, std::numbers::pi / 6.0) < 1.5 * at_rest);
}

BOOST_AUTO_TEST_CASE(vectors_are_their_components) {
  const Scene<3> scene(24, {0.5, 0.49, 0.51});
  const auto f = [&](const Vec<3>& x) { return Vec<3>{wave(x, scene.centre), x[1], std::exp(x[2])}; };
  const auto vectors = field_on<Vec<3>>(scene.band(), f);
  Field<Vec<3>, 3, Sparse> to(scene.band().lattice());
  Field<double, 3, Sparse> scalar_to(scene.band().lattice());
  ByClosestPoint<>::Method<double, 3> method;
  method(scene.band(), vectors, to, OpenMP{});
  for (int c = 0; c < 3; ++c) {
    const auto scalars = field_on<double>(scene.band(), [&](const Vec<3>& x) { return f(x)[c]; });
    method(scene.band(), method.points(), scalars, scalar_to, OpenMP{2});
    bool same = true;
    for (std::size_t b = 0; b < to.blocks(); ++b) {
      for (std::size_t i = 0; i < 512; ++i) same &= scalar_to.block(b)[i] == to.block(b)[i][c];
    }
    BOOST_TEST(same);
  }
}

BOOST_AUTO_TEST_CASE(reads_three_nodes_from_the_interface_only) {
  const Scene<2> scene(64, {0.503, 0.498});
  ByClosestPoint<>::Method<double, 2> method;
  const auto good = field_on<double>(scene.band(), [&](const Vec<2>& x) { return wave(x, scene.centre); });
  auto bad = good;
  for (std::size_t b = 0; b < bad.blocks(); ++b) {
    for (std::size_t i = 0; i < scene.band().volume; ++i) {
      // 3 sqrt(2) spacings
      if (std::abs(scene.band().values().block(b)[i]) > 4.3 / 64) bad.block(b)[i] = 1e30;
    }
  }
  Field<double, 2, Sparse> from_good(scene.band().lattice()), from_bad(scene.band().lattice());
  method(scene.band(), good, from_good, Serial{});
  method(scene.band(), bad, from_bad, Serial{});
  for (std::size_t b = 0; b < bad.blocks(); ++b) {
    for (std::size_t i = 0; i < scene.band().volume; ++i) {
      const double expected = method.points().found(b, i) ? from_good.block(b)[i] : bad.block(b)[i];
      BOOST_REQUIRE(from_bad.block(b)[i] == expected);
    }
  }
}

BOOST_AUTO_TEST_CASE(single_precision) {
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 64);
  const Vec<2> centre{0.5, 0.5};
  const LevelSet<ClosestPoint, 2, float> level_set(lattice, [&](const Vec<2>& x) { return norm(x - centre) - 0.3; });
  const auto from =
      field_on<float>(level_set.band(), [&](const Vec<2>& x) { return static_cast<float>(wave(x, centre)); });
  Field<float, 2, Sparse> to(lattice);
  ByClosestPoint<>::Method<float, 2> method;
  method(level_set.band(), from, to, Serial{});
  for (std::size_t b = 0; b < to.blocks(); ++b) {
    for (std::size_t i = 0; i < level_set.band().volume; ++i) {
      if (!method.points().found(b, i)) continue;
      const Vec<2> r = lattice.position(to.node(b, i)) - centre;
      // Newton's tolerance of 1e-4 h and round-off of phi of 1e-7, times |f'| < 20.
      BOOST_REQUIRE(std::abs(static_cast<double>(to.block(b)[i]) - wave(centre + 0.3 / norm(r) * r, centre)) < 1e-3);
    }
  }
}

BOOST_AUTO_TEST_CASE(threads_do_not_change_a_bit) {
  const Scene<3> scene(24, {0.5, 0.49, 0.51});
  const auto from = field_on<double>(scene.band(), [&](const Vec<3>& x) { return wave(x, scene.centre); });
  ByClosestPoint<>::Method<double, 3> method;
  Field<double, 3, Sparse> serial(scene.band().lattice()), other(scene.band().lattice());
  method(scene.band(), from, serial, Serial{});
  for (const int threads : {1, 2, 3}) {
    method(scene.band(), from, other, OpenMP{threads});
    for (std::size_t b = 0; b < serial.blocks(); ++b) {
      BOOST_TEST(std::memcmp(serial.block(b).data(), other.block(b).data(), 512 * sizeof(double)) == 0);
    }
  }
}

BOOST_AUTO_TEST_CASE(field_patch_continues_constants) {
  const Lattice<2> lattice({{0, 0}, {47, 48}}, 1.0, {false, true});
  Field<double, 2, Sparse> field(lattice, -7.0);
  const std::size_t b = field.activate({1, 0});
  for (std::size_t i = 0; i < 256; ++i) field.block(b)[i] = static_cast<double>(i);
  FieldPatch<double, 2> patch;
  patch.read(field, {12, -2}, {8, 6});  // columns 16, ... and rows 0, ... are stored
  const auto at = [&](int i, int j) { return patch.data(0)[i * patch.stride()[0] + j * patch.stride()[1]]; };
  BOOST_TEST(at(4, 2) == 0.0);
  BOOST_TEST(at(7, 5) == 3.0 + 3.0 * 16.0);
  BOOST_TEST(at(0, 2) == 0.0);
  BOOST_TEST(at(1, 4) == 2.0 * 16.0);
  BOOST_TEST(at(6, 0) == 2.0);
  BOOST_TEST(at(0, 0) == 0.0);
  BOOST_CHECK_THROW(patch.read(field, {34, 2}, {8, 6}), InterfaceError);
}

BOOST_AUTO_TEST_CASE(misuse_is_named) {
  const Scene<2> scene(32, {0.5, 0.5});
  ByClosestPoint<>::Method<double, 2> method;
  auto from = field_on<double>(scene.band(), [](const Vec<2>&) { return 1.0; });
  Field<double, 2, Sparse> other(scene.band().lattice());
  other.set({0, 0}, 3.0);
  Field<double, 2, Sparse> to = from;
  BOOST_CHECK_THROW(method(scene.band(), other, to, Serial{}), SizeError);
  BOOST_CHECK_THROW(method(scene.band(), from, from, Serial{}), ValueError);
  BOOST_TEST(to.blocks() == from.blocks());
  BOOST_TEST(from.block(0)[0] == 1.0);
  Field<double, 2, Sparse> elsewhere(Lattice<2>::bounded_box(Box<2>::cube(), 33));
  BOOST_CHECK_THROW(method(scene.band(), elsewhere, to, Serial{}), SizeError);
  method(scene.band(), from, elsewhere, Serial{});  // the result takes lattice and blocks
  BOOST_TEST(same_blocks(elsewhere, scene.band()));
}
