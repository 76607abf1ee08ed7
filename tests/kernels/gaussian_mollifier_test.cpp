// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE gaussian_mollifier
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <tuple>

#include <cambium/kernels/gaussian_mollifier.hpp>
#include <cambium/kernels/mollifier.hpp>

#include "gaussian_moments.hpp"

using namespace cambium;

namespace {

template <class Z, int D>
struct Case {
  using Mollifier = Z;
  static constexpr int dimension = D;
};
template <int Order>
using Z = GaussianMollifier<Order>;
using Cases = std::tuple<Case<Z<2>, 1>, Case<Z<4>, 1>, Case<Z<6>, 1>, Case<Z<2>, 2>, Case<Z<4>, 2>, Case<Z<6>, 2>,
                         Case<Z<2>, 3>, Case<Z<4>, 3>, Case<Z<6>, 3>>;
using Orders = std::tuple<Z<2>, Z<4>, Z<6>>;

}  // namespace

// Moments in closed form, without round-off: see gaussian_moments.hpp. Only even powers of every component matter.
BOOST_AUTO_TEST_CASE_TEMPLATE(moments_vanish_up_to_the_order_and_no_further, C, Cases) {
  using M = typename C::Mollifier;
  constexpr int D = C::dimension;
  BOOST_CHECK_NO_THROW(check_mollifier<M>());
  for (int a = 0; a <= M::order; a += 2) {
    for (int b = 0; a + b <= M::order && (D > 1 || b == 0); b += 2) {
      const double moment = support::gaussian_moment<D>(M::template polynomial<D>, {a, b, 0});
      const int degree = a + b;
      BOOST_TEST((moment == (degree == 0 ? 1.0 : 0.0)) == (degree < M::order), "x^" << a << " y^" << b);
    }
  }
}

// The function itself, beyond its coefficients: radial quadrature to 1e-12.
BOOST_AUTO_TEST_CASE_TEMPLATE(integral_of_the_function_is_one, C, Cases) {
  constexpr int D = C::dimension;
  using M = typename C::Mollifier;
  const double integral = support::radial_integral<D>([](double r) { return M::template radial<D>(r * r); }, 9.0);
  BOOST_TEST(std::abs(integral - 1.0) < 1e-12);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(negligible_beyond_the_cutoff, C, Cases) {
  constexpr int D = C::dimension;
  using M = typename C::Mollifier;
  for (double r = M::cutoff; r < 10.0; r += 0.1) {
    BOOST_TEST(std::abs(M::template radial<D>(r * r)) <= 1e-16 * M::template radial<D>(0.0));
  }
  const double inside = M::cutoff - 0.5;
  BOOST_TEST(std::abs(M::template radial<D>(inside * inside)) > 1e-16 * M::template radial<D>(0.0));
}

// zeta_eps * cos(x) = (1 - c eps^order + ...) cos(x): the order in eps, measured in 1D by a fine sum.
BOOST_AUTO_TEST_CASE_TEMPLATE(smoothing_error_falls_with_the_order, M, Orders) {
  const auto error = [](double epsilon) {
    double sum = 0.0;
    const double h = epsilon / 8.0;
    for (int i = -80; i <= 80; ++i) sum += h * scaled_mollifier<M>(Vec<1>{i * h}, epsilon) * std::cos(i * h);
    return std::abs(sum - 1.0);
  };
  const double order = std::log2(error(0.4) / error(0.2));
  BOOST_TEST(std::abs(order - M::order) < 0.1);  // next term: a quarter of eps^2 relative
}

BOOST_AUTO_TEST_CASE(scaled_mollifier_is_the_definition) {
  const Vec<2> x{0.3, -0.4};
  const double expected = std::exp(-0.25 / 0.16) / (std::acos(-1.0) * 0.16);
  BOOST_TEST(std::abs(scaled_mollifier<Z<2>>(x, 0.4) - expected) < 1e-15);
  BOOST_TEST(Z<2>::value(Vec<2>{0.5, 0.25}) == Z<2>::radial<2>(0.3125));
  BOOST_TEST(scaled_mollifier<Z<4>>(Vec<3>{3.0, 0.0, 0.0}, 0.4) == 0.0);
  for (const double epsilon : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    BOOST_CHECK_THROW(scaled_mollifier<Z<2>>(x, epsilon), ValueError);
  }
}
