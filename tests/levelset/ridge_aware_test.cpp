// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE ridge_aware
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <tuple>

#include <cambium/levelset/geometry/centred_differences.hpp>
#include <cambium/levelset/geometry/ridge_aware.hpp>

#include "support/exact_band.hpp"

using namespace cambium;

namespace {

template <int D_>
struct Dimension {
  static constexpr int D = D_;
};
using Dimensions = std::tuple<Dimension<2>, Dimension<3>>;

/// Two fronts `gap` spacings apart that face each other along a slanted unit vector m: half spaces or balls. Between
/// them phi has a ridge.
template <int D>
struct TwoFronts {
  double gap;
  double radius;  ///< 0: half spaces
  double h;

  static Vec<D> direction() {
    Vec<D> m = Vec<D>::constant(0.0);
    m[0] = D == 2 ? 0.6 : 2.0 / 7.0;
    m[1] = D == 2 ? 0.8 : 3.0 / 7.0;
    if (D == 3) m[D - 1] = 6.0 / 7.0;
    return m;
  }
  /// Distance to front +1 or -1, with derivatives.
  Jet<double, D> operator()(const Vec<D>& x, int front) const {
    const Vec<D> middle = Vec<D>::constant(0.503);
    const Vec<D> m = static_cast<double>(front) * direction();
    Jet<double, D> jet;
    if (radius == 0.0) {
      jet.value = 0.5 * gap * h - dot(x - middle, m);
      jet.gradient = -m;
      return jet;
    }
    const Vec<D> r = x - middle - (radius + 0.5 * gap * h) * m;
    const double length = norm(r);
    jet.value = length - radius;
    jet.gradient = r / length;
    for (int d = 0; d < D; ++d) {
      jet.hessian[d] = -jet.gradient[d] / length * jet.gradient;
      jet.hessian[d][d] += 1.0 / length;
    }
    return jet;
  }
  double distance(const Vec<D>& x) const { return std::min((*this)(x, 1).value, (*this)(x, -1).value); }
};

struct Errors {
  double normal = 0.0;
  double mean_in_spacings = 0.0;
  std::size_t nodes = 0;
};

/// Largest errors over the nodes less than 2 h from the ridge. A node within 0.1 h of half-way may take either front.
template <class G, int D>
Errors errors_at_ridge(const TwoFronts<D>& fronts, std::ptrdiff_t cells) {
  const auto lattice = Lattice<D>::bounded_box(Box<D>::cube(), cells);
  const double h = lattice.spacing();
  const auto band = support::exact_band<double>(lattice, 6.0 * h, [&](const Vec<D>& x) { return fronts.distance(x); });
  typename G::template Method<double, D> method;
  BandGeometry<double, D> geometry(lattice);
  method(band, geometry, Serial{});
  Errors e;
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      const Index<D> node = band.values().node(b, i);
      bool inner = true;  // planes run into the faces, where values are continued as constants
      for (int d = 0; d < D; ++d) inner &= node[d] >= 4 && node[d] + 4 <= cells;
      const Vec<D> x = lattice.position(node);
      const Jet<double, D> front[2] = {fronts(x, -1), fronts(x, 1)};
      const double off_ridge = 0.5 * (front[1].value - front[0].value);
      if (!inner || std::abs(off_ridge) > 2.0 * h || fronts.distance(x) > 2.0 * h) continue;
      double normal = 9.0, mean = 9.0 / h;
      for (int k = 0; k < 2; ++k) {
        if (std::abs(off_ridge) > 0.1 * h && front[k].value > front[1 - k].value) continue;
        const auto exact = surface_geometry(front[k], 1.0);
        normal = std::min(normal, norm(exact.normal - geometry.normal.block(b)[i]));
        mean = std::min(mean, std::abs(exact.mean - geometry.mean.block(b)[i]));
      }
      e = {std::max(e.normal, normal), std::max(e.mean_in_spacings, mean * h), e.nodes + 1};
    }
  }
  return e;
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(planes_that_approach, C, Dimensions) {
  constexpr int D = C::D;
  for (const double gap : {2.0, 2.4, 3.0}) {
    const TwoFronts<D> fronts{gap, 0.0, 1.0 / 32};
    const Errors centred = errors_at_ridge<CentredDifferences<2>, D>(fronts, 32);
    const Errors aware = errors_at_ridge<RidgeAware, D>(fronts, 32);
    BOOST_TEST(aware.nodes > 50u);
    // phi is linear on each side, and so exact but for the weight of stencils that just touch the ridge. One that does
    // so by delta is off by delta with the weight (epsilon / delta^2)^2: sqrt(epsilon) = 1e-3 at most.
    BOOST_TEST(aware.normal < 1e-3);
    BOOST_TEST(aware.mean_in_spacings < 2e-3);
    BOOST_TEST(centred.normal > 0.1);
    BOOST_TEST(centred.mean_in_spacings > 1.0);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(balls_that_approach, C, Dimensions) {
  constexpr int D = C::D;
  for (const double gap : {2.0, 2.5, 3.0}) {
    for (const std::ptrdiff_t cells : {32, 64}) {
      const TwoFronts<D> fronts{gap, 0.2, 1.0 / static_cast<double>(cells)};
      const Errors centred = errors_at_ridge<CentredDifferences<2>, D>(fronts, cells);
      const Errors aware = errors_at_ridge<RidgeAware, D>(fronts, cells);
      BOOST_TEST(centred.normal > 0.5);  // O(1), on every lattice
      // O(h): an orthant that is tangent to the ridge, which curves with the fronts, reaches across it by h^2 / radius.
      BOOST_TEST(aware.normal < fronts.h / fronts.radius);
      BOOST_TEST(aware.mean_in_spacings < 2.0 * fronts.h / fronts.radius);
    }
  }
}

BOOST_AUTO_TEST_CASE(half_way_takes_one_side) {
  // The node is on the ridge of phi = 1.25 - |x . m| for m along the axes and the diagonals: both sides are equal,
  // their average is no normal, and components taken axis by axis may come from different sides.
  const Lattice<3> lattice({{0, 0, 0}, {12, 12, 12}}, 1.0, {false, false, false});
  for (const Vec<3>& along :
       {Vec<3>{1, 0, 0}, Vec<3>{0, 0, 1}, Vec<3>{1, 1, 0}, Vec<3>{0, 1, -1}, Vec<3>{1, -1, 1}, Vec<3>{1, 1, 1}}) {
    const Vec<3> m = along / norm(along);
    const auto band = support::exact_band<double>(lattice, 6.0, [&](const Vec<3>& x) {
      return 1.25 - std::abs(dot(x - Vec<3>{6, 6, 6}, m));
    });
    RidgeAware::Method<double, 3> method;
    BandGeometry<double, 3> geometry(lattice);
    method(band, geometry, Serial{});
    const Vec<3> normal = geometry.normal({6, 6, 6});
    BOOST_TEST(std::min(norm(normal - m), norm(normal + m)) < 1e-3);
    BOOST_TEST(std::abs(geometry.mean({6, 6, 6})) < 1e-3);
  }
}
