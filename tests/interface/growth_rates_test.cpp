// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE growth_rates
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <tuple>

#include <cambium/interface.hpp>
#include <cambium/interface/dirichlet.hpp>
#include <cambium/levelset.hpp>
#include <cambium/poisson.hpp>

#include "interface/perturbed_ball.hpp"
#include "support/order.hpp"

using namespace cambium;
using scenes::PerturbedBall;

namespace {

/// Of the normal velocity at the interface, relative to what it is there: largest, and root of the mean square.
struct VelocityError {
  double largest = 0.0;
  double mean = 0.0;
};
struct Errors {
  VelocityError free_space, zero_outside;
};

/// Over the nodes next to the interface, at their closest points.
template <int D, class Points, class Found, class Exact>
VelocityError error_of(const NarrowBand<double, D>& band, const Points& points, Found&& found, Exact&& exact) {
  VelocityError result;
  double count = 0.0;
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      if (std::abs(band.values().block(b)[i]) > band.spacing()) continue;
      const Vec<D> x = band.lattice().position(band.values().node(b, i)) + points.offset(b, i) * band.spacing();
      const double error = std::abs(found(b, i) / exact(x) - 1.0);
      result.largest = std::max(result.largest, error);
      result.mean += error * error;
      count += 1.0;
    }
  }
  result.mean = std::sqrt(result.mean / count);
  return result;
}

template <int D>
Errors errors(std::ptrdiff_t cells, const PerturbedBall<D>& tissue) {
  using Tissue = PerturbedBall<D>;
  const auto lattice = Lattice<D>::bounded_box(Box<D>{Vec<D>::constant(-3.0), Vec<D>::constant(3.0)}, cells);
  const LevelSet<ClosestPoint, D> level_set(lattice, [&](const Vec<D>& x) { return tissue.level_set(x); });
  const auto& band = level_set.band();
  const auto& points = level_set.method().points();
  const auto pressure = [&](const Vec<D>& x) { return Tissue::tension * tissue.curvature(x); };

  Field<double, D> zero(lattice), c(lattice), f(lattice), p(lattice);
  Dirichlet<D> nutrient(band, {.shift = 1.0});
  nutrient.solve(
      zero, [](const Vec<D>&) { return 1.0; }, c);
  for (std::size_t i = 0; i < f.size(); ++i) {
    f[i] = band(lattice.node(i)) < 0.0 ? Tissue::growth * (c[i] - Tissue::decay) : 0.0;
  }

  Errors result;
  Dirichlet<D> inside(band);
  Field<double, D, Sparse> slope(lattice);
  inside.solve(f, pressure, p);
  inside.normal_derivative(band, points, p, slope);
  result.zero_outside = error_of<D>(
      band, points, [&](std::size_t b, std::size_t i) { return -slope.block(b)[i]; },
      [&](const Vec<D>& x) { return tissue.velocity_zero_outside(x); });

  Jump<D> jump(lattice);
  jump.attach(band, points);
  jump.set([&](const Vec<D>& x) { return -pressure(x); }, NoJump{},
           [](const Vec<D>&) { return -Tissue::growth * (1.0 - Tissue::decay); });
  jump.correct(f);
  FreeSpacePoisson<D>(lattice).solve(f, p);
  InterfaceSides<D> sides(lattice);
  jump.at_interface(p, sides);
  BandGeometry<double, D> geometry(lattice);
  typename AtClosestPoints<>::template Method<double, D>()(band, points, geometry, OpenMP{});
  result.free_space = error_of<D>(
      band, points,
      [&](std::size_t b, std::size_t i) {
        return -dot(sides.gradient_inside.block(b)[i], geometry.normal.block(b)[i]);
      },
      [&](const Vec<D>& x) { return tissue.velocity_free_space(x); });
  return result;
}

template <int N>
using Dimension = std::integral_constant<int, N>;
using Dimensions = std::tuple<Dimension<2>, Dimension<3>>;

}  // namespace

// The exact velocities are those of linear stability analysis, which was derived apart from them.
BOOST_AUTO_TEST_CASE_TEMPLATE(exact_velocities_agree_with_linear_stability, I, Dimensions) {
  constexpr int D = I::value;
  constexpr double delta = 1e-4;
  const PerturbedBall<D> more(delta), less(-delta);
  const Vec<D> x = PerturbedBall<D>::centre() + Vec<D>::unit(D == 2 ? 0 : D - 1, 2.0);  // Y = 1
  const double zero = (more.velocity_zero_outside(x) - less.velocity_zero_outside(x)) / (2.0 * delta);
  const double free = (more.velocity_free_space(x) - less.velocity_free_space(x)) / (2.0 * delta);
  BOOST_TEST_MESSAGE(D << "D: " << free << " (" << PerturbedBall<D>::sigma_free_space << "), " << zero << " ("
                       << PerturbedBall<D>::sigma_zero_outside << ")");
  BOOST_TEST(std::abs(free - PerturbedBall<D>::sigma_free_space) < 1e-5);  // delta^2
  BOOST_TEST(std::abs(zero - PerturbedBall<D>::sigma_zero_outside) < 1e-5);
}

// A ball and one with a mode: c from a Dirichlet problem, p from a jump in free space or from another Dirichlet
// problem. At 64 cells along a side of 6, largest errors are 0.26 to 0.33% in free space and 0.31 to 0.37% with p = 0
// outside.
BOOST_AUTO_TEST_CASE_TEMPLATE(tissue_grows_as_fast_as_it_should, I, Dimensions) {
  constexpr int D = I::value;
  for (const double delta : {0.0, 0.1}) {
    const PerturbedBall<D> tissue(delta);
    const Errors at_64 = errors<D>(64, tissue), other = errors<D>(D == 2 ? 128 : 32, tissue);
    const Errors &coarse = D == 2 ? at_64 : other, &fine = D == 2 ? other : at_64;
    const double free = support::observed_order(coarse.free_space.mean, fine.free_space.mean);
    const double zero = support::observed_order(coarse.zero_outside.mean, fine.zero_outside.mean);
    BOOST_TEST_MESSAGE(D << "D, delta " << delta << ": free space " << at_64.free_space.largest << ", mean "
                         << at_64.free_space.mean << " order " << free << "; zero outside "
                         << at_64.zero_outside.largest << ", mean " << at_64.zero_outside.mean << " order " << zero);
    BOOST_TEST(at_64.free_space.largest < 0.005);
    BOOST_TEST(at_64.zero_outside.largest < 0.005);
    BOOST_TEST(free > 1.8);
    BOOST_TEST(zero > 1.8);
  }
}
