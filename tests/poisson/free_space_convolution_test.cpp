// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE free_space_convolution
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <support/free_space.hpp>
#include <support/order.hpp>
#include <tuple>

#include <cambium/poisson.hpp>

#include "poisson/bad_input.hpp"

using cambium::Field;
using cambium::FreeSpaceConvolution;
using cambium::Index;
using cambium::Lattice;
using cambium::LatticeKernel;
using cambium::PointKernel;
using cambium::SpectralKernel;
using cambium::Vec;

namespace {

constexpr double pi = std::numbers::pi;

template <int D>
using Dimension = std::integral_constant<int, D>;
using Dimensions = std::tuple<Dimension<2>, Dimension<3>>;

template <int D, class Kernel, class T = double>
double gaussian_error(std::ptrdiff_t cells) {
  const auto lattice = Lattice<D>::bounded_box(cambium::Box<D>::cube(), cells);
  const support::Gaussian<D> gaussian;
  Field<T, D> f(lattice);
  f.sample([&](const Vec<D>& x) { return static_cast<T>(gaussian.source(x)); });
  Field<T, D> u(lattice);
  FreeSpaceConvolution<D, Kernel, T>(lattice).solve(f, u);
  return support::largest_difference(u, [&](const Vec<D>& x) { return gaussian.potential(x); });
}

}  // namespace

// Exact values: Watson's integral over 12 for D = 3, and G(m, m) = -(1 + 1/3 + ... + 1/(2 m - 1)) / pi for D = 2.
BOOST_AUTO_TEST_CASE(lattice_greens_functions_have_their_exact_values) {
  const auto space = cambium::lattice_green<3>({40, 24, 31});
  BOOST_TEST(std::abs(space[0] - 0.252731009858663) < 2e-15);
  const auto plane = cambium::lattice_green<2>({60, 60});
  BOOST_TEST(std::abs(plane[0]) < 1e-16);
  BOOST_TEST(std::abs(plane[1] + 0.25) < 1e-15);
  double sum = 0.0;
  for (std::size_t m = 1; m < 60; ++m) {
    sum += 1.0 / (2.0 * static_cast<double>(m) - 1.0);
    BOOST_TEST(std::abs(plane[61 * m] + sum / pi) < 2e-14);
  }
}

// Round-off of G, of size log(n) / (2 pi) in the plane and 1 / (4 pi) in space, times 2 D + 1 values.
BOOST_AUTO_TEST_CASE_TEMPLATE(lattice_greens_functions_solve_the_difference_equations, Which, Dimensions) {
  constexpr int D = Which::value;
  Index<D> count;
  for (int d = 0; d < D; ++d) count[d] = 40 - 7 * d;
  const auto g = cambium::lattice_green<D>(count);
  const auto at = [&](const Index<D>& n) {
    std::ptrdiff_t number = 0;
    for (int d = D - 1; d >= 0; --d) number = number * count[d] + std::abs(n[d]);
    return g[static_cast<std::size_t>(number)];
  };
  double worst = 0.0;
  for (std::ptrdiff_t i = 0; i < product(count); ++i) {
    Index<D> n;
    for (auto [d, rest] = std::pair{0, i}; d < D; rest /= count[d], ++d) n[d] = rest % count[d];
    double sum = n == Index<D>{} ? -1.0 : 0.0;
    bool inside = true;
    for (int d = 0; d < D; ++d) inside = inside && n[d] + 1 < count[d];
    for (int d = 0; inside && d < D; ++d)
      sum += 2.0 * at(n) - at(n - Index<D>::unit(d, 1)) - at(n + Index<D>::unit(d, 1));
    if (inside) worst = std::max(worst, std::abs(sum));
  }
  BOOST_TEST_MESSAGE("residual " << worst);
  BOOST_TEST(worst < 2e-14);
}

// The sum over nodes itself, for all kinds of remainders of cells by tile widths. Round-off.
BOOST_AUTO_TEST_CASE_TEMPLATE(convolution_is_the_sum_over_nodes, Which, Dimensions) {
  constexpr int D = Which::value;
  for (const auto& shape : {std::array{9, 20, 7}, std::array{1, 2, 3}, std::array{16, 5, 1}, std::array{33, 17, 2}}) {
    Index<D> cells;
    for (int d = 0; d < D; ++d) cells[d] = shape[static_cast<std::size_t>(d)];
    const auto lattice = support::bounded_lattice<D>(cells, 0.1);
    const auto f = support::noise<double>(lattice, 1);
    Field<double, D> u(lattice);
    FreeSpaceConvolution<D, PointKernel>(lattice).solve(f, u);
    const auto kernel = PointKernel::values<D>(cells, 0.1, cambium::Serial{});
    double worst = 0.0;
    for (std::size_t i = 0; i < u.size(); i += 5) {
      double sum = 0.0;
      for (std::size_t j = 0; j < u.size(); ++j) {
        const Index<D> offset = lattice.node(i) - lattice.node(j);
        std::ptrdiff_t number = 0;
        for (int d = D - 1; d >= 0; --d) number = number * (cells[d] + 1) + std::abs(offset[d]);
        sum += kernel[static_cast<std::size_t>(number)] * f[j];
      }
      worst = std::max(worst, std::abs(sum - u[i]));
    }
    BOOST_TEST(worst < 1e-15);  // of about 0.02
  }
}

// Theory: 2 for the difference equations and for point sources; spectral: round-off as soon as the source is resolved.
BOOST_AUTO_TEST_CASE_TEMPLATE(errors_of_a_gaussian_fall_as_they_should, Which, Dimensions) {
  constexpr int D = Which::value;
  const auto order = [](double coarse, double fine) { return support::observed_order(coarse, fine); };
  BOOST_TEST(std::abs(order(gaussian_error<D, LatticeKernel>(32), gaussian_error<D, LatticeKernel>(64)) - 2.0) < 0.15);
  BOOST_TEST(std::abs(order(gaussian_error<D, PointKernel>(32), gaussian_error<D, PointKernel>(64)) - 2.0) < 0.25);
  BOOST_TEST((gaussian_error<D, SpectralKernel>(64) < 1e-13));
  BOOST_TEST((gaussian_error<D, SpectralKernel>(16) > 1e-5));
  BOOST_TEST((gaussian_error<D, SpectralKernel, float>(64) < 1e-5));
}

// The source sits inside a box four times as large: what it does there is the same. Round-off.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_larger_box_changes_nothing, Which, Dimensions) {
  constexpr int D = Which::value;
  const double worst = support::difference_of_larger_box<FreeSpaceConvolution<D>, D>(12);
  BOOST_TEST_MESSAGE("difference " << worst);
  BOOST_TEST(worst < 1e-14);
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused_and_changes_nothing) {
  support::check_bad_input_is_refused<FreeSpaceConvolution<2>, 2>();
}

BOOST_AUTO_TEST_CASE(threads_do_not_change_a_bit_nor_does_solving_in_place) {
  const auto lattice = support::bounded_lattice<3>({20, 17, 9}, 0.1);
  const auto f = support::noise<double>(lattice, 5);
  const auto run = [&](int threads) {
    Field<double, 3> u = f;
    FreeSpaceConvolution<3, PointKernel, double, cambium::OpenMP> poisson(lattice, cambium::OpenMP{threads});
    poisson.solve(u, u);
    poisson.solve(f, u);
    return u;
  };
  const auto one = run(1);
  for (const int threads : {2, 3}) {
    const auto several = run(threads);
    BOOST_TEST((std::equal(one.values().begin(), one.values().end(), several.values().begin())));
  }
}
