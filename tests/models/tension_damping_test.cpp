// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE tension_damping
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include <cambium/models/tumour/tension_damping.hpp>

#include "support/order.hpp"
#include "tumour_scenes.hpp"

using namespace cambium;
using namespace scenes;

namespace {

/// Largest minus smallest curvature next to the interface.
template <class T>
double spread_of_curvature(const T& tumour) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  const auto& band = tumour.level_set().band();
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      if (std::abs(band.values().block(b)[i]) > band.spacing()) continue;
      const double curvature = tumour.geometry().mean.block(b)[i];
      least = std::min(least, curvature);
      most = std::max(most, curvature);
    }
  }
  return most - least;
}

/// Where the interface crosses the first axis: by symmetry the distance from a node there is along it.
template <class T>
double half_axis(const T& tumour) {
  const auto& lattice = tumour.lattice();
  double nearest = std::numeric_limits<double>::infinity(), result = 0.0;
  Index<T::dimension> node;
  for (int d = 0; d < T::dimension; ++d) node[d] = lattice.nodes()[d] / 2;
  for (; node[0] < lattice.nodes()[0]; ++node[0]) {
    const double phi = tumour.level_set().band()(node);
    if (std::abs(phi) >= nearest) continue;
    nearest = std::abs(phi);
    result = lattice.position(node)[0] - phi;
  }
  return result;
}

/// An ellipse, or an ellipsoid, of which tension makes a ball.
template <int D>
auto oval(double e) {
  return [e](Vec<D> x) {
    x[0] *= 1.0 + e;
    x[1] *= 1.0 - e;
    return norm(x) - 2.0;
  };
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_function_of_a_matrix_is_found) {
  // A with eigenvalues 0 to 20 along a diagonal: both functions are known for each.
  std::vector<double> x(400);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = 1.0 + std::cos(static_cast<double>(i));
  const auto b = x;
  const auto eigenvalue = [&](std::size_t i) { return 20.0 * static_cast<double>(i) / 399.0; };
  const auto apply = [&](const auto& in, auto& out) {
    for (std::size_t i = 0; i < in.size(); ++i) out[i] = eigenvalue(i) * in[i];
  };
  for (const double weight : {0.0, 0.01, 1.0, 30.0}) {
    x = b;
    detail::TensionDamping solve;
    const int products =
        weight > 0.0 ? solve.damp(1.5, weight, apply, x, OpenMP{1}) : solve.smooth(apply, x, OpenMP{1});
    double error = 0.0, size = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double a = eigenvalue(i);
      const double damped = b[i] / (1.5 + weight * std::pow(a, 1.5) * (1.0 + a * detail::TensionDamping::short_waves));
      const double exact = weight > 0.0 ? damped : b[i] / (1.0 + a * a * detail::TensionDamping::smoothing);
      error += (x[i] - exact) * (x[i] - exact);
      size += exact * exact;
    }
    BOOST_TEST_MESSAGE("weight " << weight << ": " << products << " products, off by " << std::sqrt(error / size));
    // The last piece of the basis changed less than 1e-3; what is left falls as fast as it did.
    BOOST_TEST(std::sqrt(error / size) < detail::TensionDamping::tolerance);
    BOOST_TEST(products < detail::TensionDamping::most_products);
  }
  x.assign(400, std::numeric_limits<double>::quiet_NaN());
  BOOST_CHECK_THROW(detail::TensionDamping{}.damp(1.0, 1.0, apply, x, OpenMP{1}), ValueError);
}

using Ovals = std::tuple<Tumour<2, SemiImplicit>, Tumour<2, SemiImplicit, ZeroOutside>, Tumour<3, SemiImplicit>,
                         Tumour<3, SemiImplicit, ZeroOutside>>;

// Steps of the CFL number alone, 20 to 200 times those that explicit rules allow. Noise would show in the curvature
// before anywhere else: it grew to 4 and more within 10 steps with B a third of what it is.
BOOST_AUTO_TEST_CASE_TEMPLATE(surface_tension_does_not_bound_steps, T, Ovals) {
  constexpr int D = T::dimension;
  T tumour(lattice<D>(D == 2 ? 96 : 32), oval<D>(0.15), {.parameters = {.tension = 5.0}, .change = 10.0});
  const double before = spread_of_curvature(tumour);
  for (int i = 0; i < (D == 2 ? 45 : 12); ++i) {
    const TumourStep step = tumour.step();
    BOOST_CHECK(step.bound == Limit::advection || step.bound == Limit::growth);
    BOOST_REQUIRE(spread_of_curvature(tumour) < 1.05 * before);
  }
  BOOST_TEST(spread_of_curvature(tumour) < 0.5 * before);
}

// Tension is what moves this one: the order is that of the implicit part. (4.7: at these lengths of steps two errors of
// second order nearly cancel. With the last rate left out, a rule of first order, the check fails.)
BOOST_AUTO_TEST_CASE(stiff_steps_are_of_second_order_in_time) {
  const auto at = [](int steps) {
    Tumour<2, SemiImplicit> tumour(lattice<2>(96), oval<2>(0.2),
                                   {.parameters = {.growth = 0.0, .tension = 4.0}, .courant = 10.0, .change = 10.0});
    while (0.8 - tumour.time() > 1e-12) tumour.step(std::min(0.8 / steps, 0.8 - tumour.time()));
    return half_axis(tumour);
  };
  const double few = at(8), more = at(16), many = at(32);
  const double order = support::observed_order(few - more, more - many);
  BOOST_TEST_MESSAGE("half axes " << few << ' ' << more << ' ' << many << ", order " << order);
  BOOST_TEST(order > 1.7);
}
