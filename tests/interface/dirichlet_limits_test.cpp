// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE dirichlet_limits
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <numbers>
#include <random>
#include <support/order.hpp>

#include <cambium/levelset/shapes/ball.hpp>

#include "dirichlet_scenes.hpp"

using namespace cambium;

namespace {

/// A polynomial of degree 2, for which the stencils are exact wherever they are cut.
struct Quadratic {
  double shift = 2.0;
  static double value(const Vec<2>& x) { return 1.0 + 2.0 * x[0] - x[1] + x[0] * x[0] - 3.0 * x[1] * x[1]; }
  double right_side(const Vec<2>& x) const { return shift * value(x) + 4.0; }
};

Lattice<2> unit_lattice(std::ptrdiff_t cells) { return Lattice<2>::bounded_box(Box<2>::cube(), cells); }

NarrowBand<double, 2> band_of(const Lattice<2>& lattice, const Ball<2>& ball) {
  NarrowBand<double, 2> band(lattice, 8.0 * lattice.spacing());
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const double phi = ball(lattice.position(lattice.node(i)));
    band.values().set(lattice.node(i), std::clamp(phi, -band.half_width(), band.half_width()));
  }
  band.find_far_sides();
  return band;
}

/// Largest error of the quadratic polynomial, and the number of unknowns.
std::pair<double, std::size_t> quadratic_error(const Ball<2>& ball, std::ptrdiff_t cells, Side side) {
  const auto lattice = unit_lattice(cells);
  const Quadratic problem;
  Dirichlet<2>::Params params;
  params.side = side;
  params.shift = problem.shift;
  params.tolerance = 1e-12;
  Dirichlet<2> dirichlet(band_of(lattice, ball), params);
  const auto f = sample(lattice, [&](const Vec<2>& x) { return problem.right_side(x); });
  Field<double, 2> c(lattice);
  scenes::set_walls(problem, c);
  dirichlet.solve(
      f, [&](const Vec<2>& x) { return problem.value(x); }, c);
  double error = 0.0;
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (!dirichlet.in_domain(lattice.node(i))) continue;
    error = std::max(error, std::abs(c[i] - problem.value(lattice.position(lattice.node(i)))));
  }
  return {error, dirichlet.unknowns()};
}

const auto one = [](const Vec<2>&) { return 1.0; };

}  // namespace

BOOST_AUTO_TEST_CASE(quadratic_polynomials_are_exact_wherever_the_interface_is) {
  constexpr double h = 1.0 / 32;
  for (const Side side : {Side::inside, Side::outside}) {
    // Crossings at 1e-9 h from nodes, on either side of them, and at nodes.
    for (const double beside : {0.0, 1e-9, -1e-9, 1e-13, -1e-13, 1e-5, 0.37}) {
      const auto [error, unknowns] = quadratic_error(Ball<2>({0.5, 0.5}, (10.0 + beside) * h), 32, side);
      BOOST_CHECK_LT(error, 1e-9);
      BOOST_TEST(unknowns > 300U);
    }
  }
  // Numbers of cells that cannot be halved.
  BOOST_CHECK_LT(quadratic_error(Ball<2>({0.5, 0.5}, 0.31), 51, Side::inside).first, 1e-9);
  BOOST_CHECK_LT(quadratic_error(Ball<2>({0.5, 0.5}, 0.31), 51, Side::outside).first, 1e-9);
}

BOOST_AUTO_TEST_CASE(a_domain_of_one_node) {
  constexpr double h = 1.0 / 16;
  for (const double radius : {0.9, 0.3, 0.01}) {
    const auto [error, unknowns] = quadratic_error(Ball<2>({0.5, 0.5}, radius * h), 16, Side::inside);
    BOOST_TEST(unknowns == 1U);
    BOOST_CHECK_LT(error, 1e-12);
  }
  BOOST_CHECK_THROW(quadratic_error(Ball<2>({0.5 + 0.5 * h, 0.5 + 0.5 * h}, 0.3 * h), 16, Side::inside),
                    InterfaceError);
}

BOOST_AUTO_TEST_CASE(outside_in_a_periodic_box) {
  constexpr double wave = 2.0 * std::numbers::pi;
  const auto exact = [](const Vec<2>& x) { return std::sin(wave * x[0]) + std::cos(wave * x[1]); };
  double errors[2];
  for (int k = 0; k < 2; ++k) {
    const auto lattice = Lattice<2>::periodic_box(Box<2>::cube(), 32 << k);
    Dirichlet<2> dirichlet(band_of(lattice, Ball<2>({0.52, 0.49}, 0.25)), {.side = Side::outside});
    const auto f = sample(lattice, [&](const Vec<2>& x) { return wave * wave * exact(x); });
    Field<double, 2> c(lattice);
    dirichlet.solve(f, exact, c);
    errors[k] = 0.0;
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Index<2> node = lattice.node(i);
      if (dirichlet.in_domain(node)) errors[k] = std::max(errors[k], std::abs(c[i] - exact(lattice.position(node))));
    }
  }
  BOOST_CHECK_GT(support::observed_order(errors[0], errors[1]), 1.8);
}

BOOST_AUTO_TEST_CASE(walls_that_mirror_keep_a_constant) {
  const auto lattice = unit_lattice(32);
  Dirichlet<2>::Params params;
  params.side = Side::outside;
  params.walls.fill(Wall::neumann);
  Dirichlet<2> dirichlet(band_of(lattice, Ball<2>({0.5, 0.5}, 0.2)), params);
  Field<double, 2> f(lattice), c(lattice, 5.0);
  dirichlet.solve(f, one, c);
  for (std::size_t i = 0; i < c.size(); ++i) {
    BOOST_TEST_REQUIRE(std::abs(c[i] - (dirichlet.in_domain(lattice.node(i)) ? 1.0 : 5.0)) < 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(a_good_guess_saves_iterations) {
  const auto lattice = unit_lattice(64);
  Dirichlet<2> dirichlet(band_of(lattice, Ball<2>({0.5, 0.5}, 0.3)), {.shift = 30.0, .before = 1, .after = 1});
  Field<double, 2> f(lattice), c(lattice, 1.0);
  const auto cold = dirichlet.solve(f, one, c);
  const auto warm = dirichlet.solve(f, one, c);
  BOOST_TEST(warm.iterations == 0);
  dirichlet.update(band_of(lattice, Ball<2>({0.5, 0.5}, 0.30001)));
  const auto moved = dirichlet.solve(f, one, c);
  BOOST_TEST(moved.iterations < cold.iterations);
  BOOST_TEST(moved.residuals.front() < 0.01);
}

BOOST_AUTO_TEST_CASE(single_precision_fields) {
  const auto lattice = unit_lattice(48);
  const auto band = band_of(lattice, Ball<2>({0.51, 0.49}, 0.3));
  const Quadratic problem;
  const auto f = sample(lattice, [&](const Vec<2>& x) { return static_cast<float>(problem.right_side(x)); });
  Field<float, 2> c(lattice);
  Dirichlet<2, float> dirichlet(band, {.shift = problem.shift});
  dirichlet.solve(
      f, [&](const Vec<2>& x) { return problem.value(x); }, c);
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (!dirichlet.in_domain(lattice.node(i))) continue;
    // Round-off of f and c: 6e-8 of values up to 4.
    BOOST_TEST_REQUIRE(std::abs(c[i] - problem.value(lattice.position(lattice.node(i)))) < 1e-6);
  }
}

BOOST_AUTO_TEST_CASE(threads_change_no_bit) {
  const auto lattice = unit_lattice(96);
  const auto band = band_of(lattice, Ball<2>({0.51, 0.49}, 0.4));
  const auto f = sample(lattice, [](const Vec<2>& x) { return std::sin(9.0 * x[0] * x[1]); });
  const auto g = [](const Vec<2>& x) { return x[0]; };
  Field<double, 2> reference(lattice);
  Dirichlet<2>(band, {}, OpenMP{1}).solve(f, g, reference);
  for (const int threads : {2, 3}) {
    Field<double, 2> c(lattice);
    Dirichlet<2>(band, {}, OpenMP{threads}).solve(f, g, c);
    BOOST_TEST(std::ranges::equal(c.values(), reference.values()));
  }
}

BOOST_AUTO_TEST_CASE(what_cannot_be_solved_is_told) {
  const auto lattice = unit_lattice(64);
  const auto band = band_of(lattice, Ball<2>({0.5, 0.5}, 0.3));
  auto f = sample(lattice, [](const Vec<2>& x) { return x[0]; });
  auto c = sample(lattice, [](const Vec<2>& x) { return std::sin(40.0 * x[1]); });
  const auto before = c;
  const auto unchanged = [&] { return std::ranges::equal(c.values(), before.values()); };
  Dirichlet<2> hasty(band, {.tolerance = 1e-12, .most_iterations = 1});
  BOOST_CHECK_EXCEPTION(hasty.solve(f, one, c), ConvergenceError, [](const ConvergenceError& e) {
    return e.residuals().size() >= 2 && e.residuals().back() > 1e-12;
  });
  BOOST_TEST(unchanged());

  Dirichlet<2> dirichlet(band);
  Field<double, 2, Sparse> derivative(lattice);
  BOOST_CHECK_THROW(dirichlet.continue_beyond(c), ValueError);  // nothing solved yet
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  f({32, 30}) = nan;
  BOOST_CHECK_THROW(dirichlet.solve(f, one, c), ValueError);
  f({32, 30}) = 0.0;
  f({1, 1}) = nan;  // not of the domain
  BOOST_CHECK_THROW(dirichlet.solve(
                        f, [](const Vec<2>&) { return nan; }, c),
                    ValueError);
  BOOST_TEST(unchanged());
  BOOST_CHECK_NO_THROW(dirichlet.solve(f, one, c));
  c({32, 30}) = nan;
  BOOST_CHECK_THROW(dirichlet.solve(f, one, c), ValueError);
  BOOST_CHECK_THROW(dirichlet.continue_beyond(c), ValueError);
  Field<double, 2> other(unit_lattice(32));
  BOOST_CHECK_THROW(dirichlet.solve(f, one, other), SizeError);
  BOOST_CHECK_THROW(dirichlet.update(band_of(unit_lattice(32), Ball<2>({0.5, 0.5}, 0.3))), SizeError);
  BOOST_CHECK_THROW(Dirichlet<2>(band, {.shift = -1.0}), ValueError);
}
