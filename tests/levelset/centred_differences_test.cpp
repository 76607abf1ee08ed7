// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE centred_differences
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstring>
#include <tuple>

#include <cambium/levelset/geometry/centred_differences.hpp>
#include <cambium/levelset/geometry/ridge_aware.hpp>

#include "support/ellipsoid.hpp"
#include "support/exact_band.hpp"
#include "support/order.hpp"

using namespace cambium;

static_assert(GeometryPolicy<CentredDifferences<2>> && GeometryPolicy<CentredDifferences<4>>);
static_assert(GeometryPolicy<RidgeAware> && !GeometryPolicy<int>);

namespace {

template <class G, int D, int NormalOrder, int CurvatureOrder>
struct Case {
  using Policy = G;
  static constexpr int dimension = D;
  static constexpr int normal_order = NormalOrder;
  static constexpr int curvature_order = CurvatureOrder;
};
using Cases = std::tuple<Case<CentredDifferences<2>, 2, 2, 2>, Case<CentredDifferences<4>, 2, 4, 4>,
                         Case<CentredDifferences<2>, 3, 2, 2>, Case<CentredDifferences<4>, 3, 4, 4>,
                         Case<RidgeAware, 2, 4, 2>, Case<RidgeAware, 3, 4, 2>>;

struct Errors {
  double normal = 0.0, mean = 0.0, gaussian = 0.0;
};

/// On the exact distance of a ball the level set through x is a sphere of radius |x - centre|.
template <class G, int D>
Errors errors(std::ptrdiff_t cells) {
  const auto lattice = Lattice<D>::bounded_box(Box<D>::cube(), cells);
  const double h = lattice.spacing();
  const Vec<D> centre = Vec<D>::constant(0.5) + Vec<D>::unit(0, 0.013) - Vec<D>::unit(1, 0.007);
  const auto ball = support::Ellipsoid<D>::ball(0.3, centre);
  const auto band =
      support::exact_band<double>(lattice, 6.0 * h, [&](const Vec<D>& x) { return norm(x - centre) - 0.3; });
  typename G::template Method<double, D> method;
  BandGeometry<double, D> geometry(lattice);
  method(band, geometry, Serial{});
  Errors e;
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      const bool defined = geometry.defined(b, i);
      if (!(std::abs(band.values().block(b)[i]) < 2.0 * h)) continue;
      BOOST_REQUIRE(defined);  // 6 h - sqrt(2) 2 h > 2 h
      const auto exact = ball.geometry(lattice.position(band.values().node(b, i)));
      e.normal = std::max(e.normal, norm(exact.normal - geometry.normal.block(b)[i]));
      e.mean = std::max(e.mean, std::abs(exact.mean - geometry.mean.block(b)[i]));
      if constexpr (D == 3) {
        e.gaussian = std::max(e.gaussian, std::abs(exact.gaussian - geometry.gaussian.block(b)[i]));
      }
    }
  }
  return e;
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(order_on_exact_distances, C, Cases) {
  constexpr int D = C::dimension;
  const Errors coarse = errors<typename C::Policy, D>(D == 2 ? 96 : 48);
  const Errors fine = errors<typename C::Policy, D>(D == 2 ? 192 : 96);
  // 0.2 below the order is the tolerance of all order tests of the library.
  BOOST_TEST(support::observed_order(coarse.normal, fine.normal) > C::normal_order - 0.2);
  BOOST_TEST(support::observed_order(coarse.mean, fine.mean) > C::curvature_order - 0.2);
  if (D == 3) BOOST_TEST(support::observed_order(coarse.gaussian, fine.gaussian) > C::curvature_order - 0.2);
}

BOOST_AUTO_TEST_CASE(quadratics_are_exact) {
  // Three-point stencils and products of first differences are exact for polynomials of degree 2, one-sided ones too
  // for the derivatives that do not mix.
  const Lattice<3> lattice({{0, 0, 0}, {16, 16, 16}}, 1.0, {false, false, false});
  const auto ellipsoid = support::Ellipsoid<3>{{3.0, 5.0, 4.0}, {8.1, 7.7, 8.2}, 0.4};
  const auto band = support::exact_band<double>(lattice, 6.0, [&](const Vec<3>& x) { return ellipsoid(x).value; });
  const auto check = [&](auto method) {
    BandGeometry<double, 3> geometry(lattice);
    method(band, geometry, Serial{});
    for (const Index<3>& node : {Index<3>{7, 7, 8}, Index<3>{8, 6, 9}, Index<3>{9, 9, 9}}) {
      const auto exact = ellipsoid.geometry(lattice.position(node));
      BOOST_TEST(norm(geometry.normal(node) - exact.normal) < 1e-13);
      BOOST_TEST(geometry.mean(node) == exact.mean, boost::test_tools::tolerance(1e-12));
      BOOST_TEST(geometry.gaussian(node) == exact.gaussian, boost::test_tools::tolerance(1e-12));
    }
  };
  check(CentredDifferences<2>::Method<double, 3>());
  check(CentredDifferences<4>::Method<double, 3>());
  check(RidgeAware::Method<double, 3>());
}

BOOST_AUTO_TEST_CASE(nothing_is_defined_where_values_are_cut_off) {
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 64);
  const double h = lattice.spacing();
  const auto band = support::exact_band<float>(lattice, 6.0 * h, [](const Vec<2>& x) {
    return norm(x - Vec<2>{0.5, 0.5}) - 0.3;
  });
  BandGeometry<float, 2> geometry(lattice);
  CentredDifferences<4>::Method<float, 2> method;
  method(band, geometry, Serial{});
  std::size_t defined = 0;
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      const bool expected = std::abs(static_cast<double>(band.values().block(b)[i])) < (6.0 - 2.0 * std::sqrt(2.0)) * h;
      if (band.lattice().contains(band.values().node(b, i))) BOOST_TEST(geometry.defined(b, i) == expected);
      defined += expected;
      // Round-off of phi, 6e-8 * 0.3, over a spacing, times the weights: 1e-5; of curvature over h^2: 1e-3. Truncation
      // is below both.
      if (!expected) continue;
      const Vec<2> r = lattice.position(band.values().node(b, i)) - Vec<2>{0.5, 0.5};
      BOOST_TEST(std::abs(static_cast<double>(geometry.mean.block(b)[i]) - 1.0 / norm(r)) < 1e-3);
    }
  }
  BOOST_TEST(defined > 64u);
  BOOST_TEST(geometry.gaussian.blocks() == 0u);
}

BOOST_AUTO_TEST_CASE(threads_do_not_change_a_bit) {
  const auto lattice = Lattice<3>::periodic_box(Box<3>::cube(), 20);
  const auto band = support::exact_band<double>(lattice, 0.3, [](const Vec<3>& x) {
    return norm(x - Vec<3>{0.5, 0.48, 0.51}) - 0.3;
  });
  BandGeometry<double, 3> serial(lattice);
  RidgeAware::Method<double, 3> method;
  method(band, serial, Serial{});
  for (const int threads : {1, 2, 3}) {
    BandGeometry<double, 3> other(lattice);
    method(band, other, OpenMP{threads});
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      BOOST_TEST(std::memcmp(serial.mean.block(b).data(), other.mean.block(b).data(), 512 * sizeof(double)) == 0);
      BOOST_TEST(std::memcmp(serial.normal.block(b).data(), other.normal.block(b).data(), 512 * sizeof(Vec<3>)) == 0);
    }
  }
}
