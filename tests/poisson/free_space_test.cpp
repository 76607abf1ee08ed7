// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE free_space
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <support/free_space.hpp>
#include <support/order.hpp>
#include <tuple>

#include <cambium/poisson.hpp>

#include "poisson/bad_input.hpp"

using cambium::Field;
using cambium::FreeSpaceConvolution;
using cambium::FreeSpacePoisson;
using cambium::Index;
using cambium::Lattice;
using cambium::LatticeKernel;
using cambium::Vec;

// Against the plain sum, for equal, unequal, even, odd and smallest lengths, sources on faces, edges and corners
// included. Round-off: 1e-15 and 1e-7 of a value of 0.1, and a few; measured 7e-16 and 1e-7.
BOOST_AUTO_TEST_CASE_TEMPLATE(boundary_values_make_the_sum_over_nodes, T, decltype(std::tuple<double, float>())) {
  const double tolerance = sizeof(T) == sizeof(double) ? 5e-15 : 1e-6;
  for (const Index<3>& cells :
       {Index<3>{8, 8, 8}, {16, 16, 16}, {9, 9, 9}, {12, 7, 9}, {2, 5, 3}, {20, 20, 33}, {7, 18, 7}}) {
    const auto lattice = support::bounded_lattice<3>(cells, 0.1);
    const auto f = support::noise<T>(lattice, 1);
    Field<T, 3> sum(lattice), u(lattice);
    FreeSpaceConvolution<3, LatticeKernel, T>(lattice).solve(f, sum);
    FreeSpacePoisson<3, T> poisson(lattice);
    poisson.solve(f, u);
    double worst = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) worst = std::max(worst, std::abs(static_cast<double>(u[i] - sum[i])));
    BOOST_TEST_MESSAGE(cells << " difference " << worst);
    BOOST_TEST(worst < tolerance);
    Field<T, 3> again = f;
    poisson.solve(again, again);
    BOOST_TEST((std::equal(u.values().begin(), u.values().end(), again.values().begin())));
  }
}

// The source sits inside a box four times as large: what it does there is the same. Round-off.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_larger_box_changes_nothing, Which,
                              decltype(std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>())) {
  constexpr int D = Which::value;
  const double worst = support::difference_of_larger_box<FreeSpacePoisson<D>, D>(16);
  BOOST_TEST_MESSAGE("difference " << worst);
  BOOST_TEST(worst < 1e-12);
}

// Theory: 2.
BOOST_AUTO_TEST_CASE(the_potential_of_a_gaussian_has_second_order) {
  const support::Gaussian<3> gaussian;
  const auto error = [&](std::ptrdiff_t cells) {
    const auto lattice = Lattice<3>::bounded_box(cambium::Box<3>::cube(), cells);
    const auto f = sample(lattice, [&](const Vec<3>& x) { return gaussian.source(x); });
    Field<double, 3> u(lattice);
    FreeSpacePoisson<3>(lattice).solve(f, u);
    return support::largest_difference(u, [&](const Vec<3>& x) { return gaussian.potential(x); });
  };
  const double order = support::observed_order(error(32), error(64));
  BOOST_TEST_MESSAGE("order " << order);
  BOOST_TEST(std::abs(order - 2.0) < 0.15);
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused_and_changes_nothing) {
  support::check_bad_input_is_refused<FreeSpacePoisson<3>, 3>();
  BOOST_CHECK_THROW(FreeSpacePoisson<3>(Lattice<3>::bounded_box(cambium::Box<3>::cube(), 1)), cambium::LatticeError);
}

BOOST_AUTO_TEST_CASE(threads_do_not_change_a_bit) {
  const auto lattice = support::bounded_lattice<3>({40, 17, 24}, 0.1);
  const auto f = support::noise<double>(lattice, 5);
  const auto run = [&](int threads) {
    Field<double, 3> u(lattice);
    FreeSpacePoisson<3> poisson(lattice, cambium::OpenMP{threads});
    poisson.solve(f, u);
    return u;
  };
  const auto one = run(1);
  for (const int threads : {2, 3}) {
    const auto several = run(threads);
    BOOST_TEST((std::equal(one.values().begin(), one.values().end(), several.values().begin())));
  }
}
