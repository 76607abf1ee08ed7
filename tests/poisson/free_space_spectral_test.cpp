// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE free_space_spectral
#include <boost/test/unit_test.hpp>
#include <limits>
#include <support/free_space.hpp>
#include <support/order.hpp>
#include <tuple>

#include <cambium/operators/differences.hpp>
#include <cambium/poisson.hpp>

using cambium::Box;
using cambium::Field;
using cambium::FreeSpaceSpectral;
using cambium::Lattice;
using cambium::Vec;

namespace {

template <int D>
double largest(const Field<Vec<D>, D>& g, auto&& exact) {
  double worst = 0.0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    worst = std::max(worst, norm(g[i] - exact(g.lattice().position(g.lattice().node(i)))));
  }
  return worst;
}

}  // namespace

// The gradient of the Gaussian's potential is its source's integral over a ball, over the surface. The Gaussian is 1.6
// and 3.2 spacings wide; measured 1.4e-5 and 5e-14 (3D).
BOOST_AUTO_TEST_CASE_TEMPLATE(gradients_in_free_space, Which,
                              decltype(std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>())) {
  constexpr int D = Which::value;
  const support::Gaussian<D> gaussian;
  const double pi = std::numbers::pi;
  const auto exact = [&](const Vec<D>& x) {
    const Vec<D> away = x - gaussian.centre;
    const double r = norm(away), s = r / gaussian.width;
    const double bell = std::exp(-0.5 * s * s);
    const double inside =
        D == 2 ? -std::expm1(-0.5 * s * s) : std::erf(s / std::numbers::sqrt2) - std::sqrt(2.0 / pi) * s * bell;
    return r < 1e-6 ? Vec<D>{} : away * (-inside / (D == 2 ? 2.0 * pi * r * r : 4.0 * pi * r * r * r));
  };
  double before = std::numeric_limits<double>::infinity();
  for (const std::ptrdiff_t cells : {32, 64}) {
    const auto lattice = Lattice<D>::bounded_box(Box<D>::cube(), cells);
    const auto f = sample(lattice, [&](const Vec<D>& x) { return gaussian.source(x); });
    Field<double, D> u(lattice), alone(lattice);
    Field<Vec<D>, D> g(lattice);
    FreeSpaceSpectral<D> poisson(lattice);
    poisson.solve(f, u, g);
    poisson.solve(f, alone);
    BOOST_TEST((std::equal(u.values().begin(), u.values().end(), alone.values().begin())));
    const double error = largest<D>(g, exact);
    BOOST_TEST_MESSAGE(D << "D " << cells << " cells: error of the gradient " << error);
    BOOST_TEST(error < (cells == 32 ? 1e-4 : 1e-12));
    BOOST_TEST(error < 1e-6 * before);
    before = error;
    auto bad = f;
    bad[3] = std::nan("");
    BOOST_CHECK_THROW(poisson.solve(bad, u, g), cambium::ValueError);
    BOOST_TEST(largest<D>(g, exact) == error);
  }
}

// Differences of the order of the symbol keep it, at faces of either kind as well. Theory: 2 and 4 or, as long as the
// one-sided differences at the faces err most, 5: here the fifth derivatives across them vanish. Measured 4.8.
BOOST_AUTO_TEST_CASE(gradients_in_a_box) {
  const double pi = std::numbers::pi;
  const auto exact = [=](const Vec<2>& x) { return std::sin(pi * x[0]) * std::cos(2.0 * pi * x[1]); };
  const auto slope = [=](const Vec<2>& x) {
    return Vec<2>{pi * std::cos(pi * x[0]) * std::cos(2.0 * pi * x[1]),
                  -2.0 * pi * std::sin(pi * x[0]) * std::sin(2.0 * pi * x[1])};
  };
  const auto order = [&]<class Symbol>(Symbol) {
    const auto error = [&](std::ptrdiff_t cells) {
      const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), cells);
      const auto f = sample(lattice, [&](const Vec<2>& x) { return 5.0 * pi * pi * exact(x); });
      Field<double, 2> u(lattice);
      Field<Vec<2>, 2> g(lattice);
      cambium::BoxPoisson<2, Symbol> poisson(lattice, {cambium::Boundary::dirichlet, cambium::Boundary::neumann});
      poisson.solve(f, u);
      cambium::CentredDifference<Symbol::order>::gradient(u, g);
      return largest<2>(g, slope);
    };
    return support::observed_order(error(48), error(96));
  };
  const double second = order(cambium::SecondOrder()), fourth = order(cambium::FourthOrder());
  BOOST_TEST_MESSAGE("orders " << second << ' ' << fourth);
  BOOST_TEST(std::abs(second - 2.0) < 0.15);
  BOOST_TEST(fourth > 3.8);
}
