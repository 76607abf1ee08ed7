// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE free_space_dirichlet
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <support/free_space.hpp>
#include <support/order.hpp>
#include <tuple>

#include <cambium/poisson/free_space_dirichlet.hpp>

#include "poisson/bad_input.hpp"

using cambium::Field;
using cambium::FreeSpaceConvolution;
using cambium::FreeSpaceDirichlet;
using cambium::Lattice;
using cambium::LatticeKernel;
using cambium::Vec;

using Dimensions = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

// Theory: 2, of the point sources as of the difference equations.
BOOST_AUTO_TEST_CASE_TEMPLATE(the_potential_of_a_gaussian_has_second_order, Which, Dimensions) {
  constexpr int D = Which::value;
  const support::Gaussian<D> gaussian;
  const auto error = [&](std::ptrdiff_t cells) {
    const auto lattice = Lattice<D>::bounded_box(cambium::Box<D>::cube(), cells);
    const auto f = sample(lattice, [&](const Vec<D>& x) { return gaussian.source(x); });
    Field<double, D> u(lattice);
    FreeSpaceDirichlet<D>(lattice).solve(f, u);
    return support::largest_difference(u, [&](const Vec<D>& x) { return gaussian.potential(x); });
  };
  const double order = support::observed_order(error(32), error(64));
  BOOST_TEST_MESSAGE("order " << order);
  BOOST_TEST(std::abs(order - 2.0) < 0.15);
}

// With values from the lattice Green's function both steps solve the same equations: nothing changes. Round-off.
BOOST_AUTO_TEST_CASE_TEMPLATE(lattice_values_fit_the_difference_equations, Which, Dimensions) {
  constexpr int D = Which::value;
  cambium::Index<D> cells;
  for (int d = 0; d < D; ++d) cells[d] = 14 + 3 * d;
  const auto lattice = support::bounded_lattice<D>(cells, 0.1);
  const auto f = support::noise<double>(lattice, 3);
  Field<double, D> u(lattice), sum(lattice);
  FreeSpaceDirichlet<D, LatticeKernel> poisson(lattice);
  poisson.solve(f, u);
  FreeSpaceConvolution<D>(lattice).solve(f, sum);
  double worst = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) worst = std::max(worst, std::abs(u[i] - sum[i]));
  BOOST_TEST(worst < 1e-14);
  Field<double, D> again = f;
  poisson.solve(again, again);
  BOOST_TEST((std::equal(u.values().begin(), u.values().end(), again.values().begin())));
}

// What the convolution alone does not: f by the stencil inside. Round-off of u / h^2 = 0.1 * 100, and a few.
BOOST_AUTO_TEST_CASE(inside_the_difference_equations_hold) {
  const auto lattice = support::bounded_lattice<3>({12, 9, 10}, 0.1);
  const auto f = support::noise<double>(lattice, 4);
  Field<double, 3> u(lattice);
  const auto residual = [&] {
    double worst = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      const auto node = lattice.node(i);
      double sum = -f[i] * 0.01;
      bool inside = true;
      for (int d = 0; d < 3; ++d) inside = inside && node[d] > 0 && node[d] + 1 < lattice.nodes()[d];
      for (int d = 0; inside && d < 3; ++d) {
        const auto way = cambium::Index<3>::unit(d, 1);
        sum += 2.0 * u[i] - u(node - way) - u(node + way);
      }
      if (inside) worst = std::max(worst, std::abs(sum) / 0.01);
    }
    return worst;
  };
  FreeSpaceDirichlet<3>(lattice).solve(f, u);
  BOOST_TEST(residual() < 1e-12);
  FreeSpaceConvolution<3, cambium::PointKernel>(lattice).solve(f, u);
  BOOST_TEST(residual() > 1e-2);
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused_and_changes_nothing) {
  support::check_bad_input_is_refused<FreeSpaceDirichlet<2>, 2>();
}
