// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE gaussian_pse
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <tuple>
#include <vector>

#include <cambium/kernels/algebraic_pse.hpp>
#include <cambium/kernels/gaussian_pse.hpp>
#include <cambium/kernels/pse_kernel.hpp>

#include "gaussian_moments.hpp"

using namespace cambium;

namespace {

template <class K_, int D>
struct Case {
  using K = K_;
  static constexpr int dimension = D;
};
using Cases =
    std::tuple<Case<Gaussian2, 1>, Case<Gaussian4, 1>, Case<Gaussian6, 1>, Case<Gaussian2, 2>, Case<Gaussian4, 2>,
               Case<Gaussian6, 2>, Case<Gaussian2, 3>, Case<Gaussian4, 3>, Case<Gaussian6, 3>>;
using Orders = std::tuple<Gaussian2, Gaussian4, Gaussian6>;

const double pi = std::acos(-1.0);

/// h sum_i eta(i h) (i h)^power in 1D: moments that a lattice of spacing h (in units of eps) sees.
template <class K>
double lattice_moment(double h, int power) {
  double sum = 0.0;
  for (int i = -60; i <= 60; ++i) sum += h * K::template laplacian<1>(i * h * i * h) * std::pow(i * h, power);
  return sum;
}

/// Fourier transform of eta at wave number k in 1D, by a sum that is exact to round-off for h = 1/4.
template <class K>
double symbol(double k) {
  double sum = 0.0;
  for (int i = -40; i <= 40; ++i) sum += 0.25 * K::template laplacian<1>(i * i / 16.0) * std::cos(k * i * 0.25);
  return sum;
}

}  // namespace

BOOST_AUTO_TEST_CASE(statements_hold_at_compile_time) {
  check_pse_kernel<Gaussian2>();
  check_pse_kernel<Gaussian4>();
  check_pse_kernel<Gaussian6>();
  check_pse_kernel<Algebraic2>();
  static_assert(PSEKernelIn<Algebraic2, 2> && !PSEKernelIn<Algebraic2, 1>);
  BOOST_TEST(true);
}

// In closed form without round-off: all moments of degree 1, ..., order + 1 vanish but int x_i^2 eta = 2.
BOOST_AUTO_TEST_CASE_TEMPLATE(laplacian_moments, C, Cases) {
  using K = typename C::K;
  constexpr int D = C::dimension;
  const auto& c = K::template polynomial<D>;
  BOOST_TEST(support::gaussian_moment<D>(c, {0, 0, 0}) == K::template zeroth_moment<D>);
  BOOST_TEST(support::gaussian_moment<D>(c, {2, 0, 0}) == 2.0);
  for (int a = 0; a <= K::order; a += 2) {
    for (int b = 0; a + b <= K::order && (D > 1 || b == 0); b += 2) {
      if (a + b > 2) BOOST_TEST(support::gaussian_moment<D>(c, {a, b, 0}) == 0.0, "x^" << a << " y^" << b);
    }
  }
  // The first error moment int x_1^(order + 2) eta: the same in every dimension.
  const double error_moment = K::order == 2 ? 3.0 : K::order == 4 ? -7.5 : 26.25;
  BOOST_TEST(support::gaussian_moment<D>(c, {K::order + 2, 0, 0}) == error_moment);
}

// eta_i = x_i g: int x_i eta_i = -1, all other moments of degree 0, ..., order vanish; g = -eta / 2.
BOOST_AUTO_TEST_CASE_TEMPLATE(gradient_moments, C, Cases) {
  using K = typename C::K;
  constexpr int D = C::dimension;
  auto g = K::template polynomial<D>;
  for (double& coefficient : g) coefficient *= -0.5;
  BOOST_TEST(support::gaussian_moment<D>(g, {2, 0, 0}) == -1.0);
  for (int a = 2; a <= K::order; a += 2) {
    for (int b = 0; a + b <= K::order && (D > 1 || b == 0); b += 2) {
      if (a + b > 2) BOOST_TEST(support::gaussian_moment<D>(g, {a, b, 0}) == 0.0);
    }
  }
  for (const double rho2 : {0.0, 0.3, 2.0, 11.0}) {
    double polynomial = 0.0;
    for (std::size_t k = g.size(); k-- > 0;) polynomial = polynomial * rho2 + g[k];
    const double expected = std::pow(pi, -0.5 * D) * polynomial * std::exp(-rho2);
    BOOST_TEST(std::abs(K::template gradient<D>(rho2) - expected) <= 1e-15);
    BOOST_TEST(K::template gradient<D>(rho2) == -0.5 * K::template laplacian<D>(rho2));
  }
}

// The polynomials of the table of kernels, at one point: rho^2 = 1/2.
BOOST_AUTO_TEST_CASE(printed_polynomials) {
  const double weight = std::exp(-0.5);
  const auto norm = [](int d) { return std::pow(pi, -0.5 * d); };
  const auto close = [](double a, double b) { return std::abs(a - b) < 1e-14; };
  BOOST_TEST(close(Gaussian2::laplacian<1>(0.5), 4.0 * norm(1) * weight));
  BOOST_TEST(close(Gaussian4::laplacian<1>(0.5), 8.0 * norm(1) * weight));   // -2 (2 u - 5)
  BOOST_TEST(close(Gaussian4::laplacian<2>(0.5), 10.0 * norm(2) * weight));  // -4 (u - 3)
  BOOST_TEST(close(Gaussian4::laplacian<3>(0.5), 12.0 * norm(3) * weight));  // -2 (2 u - 7)
  BOOST_TEST(close(Gaussian6::laplacian<1>(0.5), 11.0 * norm(1) * weight));  // (4 u^2 - 28 u + 35) / 2
  BOOST_TEST(close(Gaussian6::laplacian<2>(0.5), 16.5 * norm(2) * weight));  // 2 (u - 6) (u - 2)
  BOOST_TEST(close(Gaussian6::laplacian<3>(0.5), 23.0 * norm(3) * weight));  // (4 u^2 - 36 u + 63) / 2
  BOOST_TEST(close(Gaussian6::gradient<2>(0.5), -8.25 * norm(2) * weight));  // -(u - 6) (u - 2)
}

// eta_hat(k) = 4 exp(-z) sum_j (n + 1 - j) z^j / j!, z = k^2 / 4; M_0 - eta_hat increases to M_0, hence the step limit.
BOOST_AUTO_TEST_CASE_TEMPLATE(symbol_is_the_closed_form, K, Orders) {
  double before = -1.0;
  for (double k = 0.0; k < 10.0; k += 0.25) {
    const double z = k * k / 4.0;
    double sum = 0.0, power = 1.0;
    for (int j = 0; j < K::order / 2; ++j) {
      sum += (K::order / 2 - j) * power;
      power *= z / (j + 1);
    }
    BOOST_TEST(std::abs(symbol<K>(k) - 4.0 * std::exp(-z) * sum) < 1e-13);
    const double rate = K::template zeroth_moment<1> - symbol<K>(k);
    BOOST_TEST(rate > before - 1e-13);
    before = rate;
  }
  BOOST_TEST(before <= K::template zeroth_moment<1> + 1e-13);
}

struct LatticeRow {
  double spacing;
  std::array<double, 3> zeroth, second, fourth;
};

// Moments that a lattice sees, from an independent computation with 40 digits.
BOOST_AUTO_TEST_CASE(lattice_moments) {
  const std::vector<LatticeRow> rows{
      {0.5, {4.0, 8.0, 12.0}, {2.0, 2.0, 2.0}, {3.0, 3.086e-12, 5.760e-11}},
      {0.8,
       {4.0000016059, 8.0000279771, 12.0002453040},
       {1.9999760377, 1.9996312741, 1.9971638856},
       {3.0, 4.073e-3, 2.647e-2}},
      {1.0,
       {4.0004137855, 8.0049114701, 12.0295623889},
       {1.9961229937, 1.9619423739, 1.8134210103},
       {3.028, 2.116e-1, 7.471e-1}},
      {1.25,
       {4.0144493584, 8.1201687669, 12.5141439684},
       {1.9159546290, 1.4763481184, 0.3762058746},
       {3.314, 1.101, 1.278}},
  };
  const auto compare = [](auto kernel, const LatticeRow& row, int column) {
    using K = decltype(kernel);
    // Tolerances: the digits of the table; round-off of the sum for what is 1e-11 and below.
    BOOST_TEST(std::abs(lattice_moment<K>(row.spacing, 0) - row.zeroth[column]) < 6e-11);
    BOOST_TEST(std::abs(lattice_moment<K>(row.spacing, 2) - row.second[column]) < 6e-11);
    BOOST_TEST(std::abs(lattice_moment<K>(row.spacing, 4) - row.fourth[column]) < 6e-4 * row.fourth[column] + 1e-13);
  };
  for (const LatticeRow& row : rows) {
    compare(Gaussian2{}, row, 0);
    compare(Gaussian4{}, row, 1);
    compare(Gaussian6{}, row, 2);
  }
}

// The relative floor of the Laplacian on a lattice, at the declared largest spacing and a tenth beyond it.
BOOST_AUTO_TEST_CASE_TEMPLATE(largest_spacing_keeps_the_floor_low, K, Orders) {
  const auto floor = [](double h) { return std::abs(lattice_moment<K>(h, 2) / 2.0 - 1.0); };
  const double declared = K::order == 2 ? 1.20e-5 : K::order == 4 ? 3.66e-9 : 8.69e-13;
  BOOST_TEST(std::abs(floor(K::largest_spacing) - declared) < 0.01 * declared);
  BOOST_TEST(floor(K::largest_spacing + 0.1) > 10.0 * declared);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(negligible_beyond_the_cutoff, C, Cases) {
  using K = typename C::K;
  constexpr int D = C::dimension;
  for (double r = K::cutoff; r < 10.0; r += 0.1) {
    BOOST_TEST(std::abs(K::template laplacian<D>(r * r)) <= 1e-16 * K::template laplacian<D>(0.0));
  }
}

// q = sin(x) on a 1D lattice with h = eps / 2: the error of both operators falls with the declared order.
BOOST_AUTO_TEST_CASE_TEMPLATE(measured_order, K, Orders) {
  const auto errors = [](double epsilon) {
    const double h = 0.5 * epsilon, x = 0.7;
    double laplacian = 0.0, derivative = 0.0;
    for (int i = -20; i <= 20; ++i) {
      const double rho = 0.5 * i;  // (x - y) / eps
      const double q = std::sin(x - i * h);
      laplacian += h / epsilon * (q - std::sin(x)) * K::template laplacian<1>(rho * rho);
      derivative += h / epsilon * (q + std::sin(x)) * rho * K::template gradient<1>(rho * rho);
    }
    return std::array{std::abs(laplacian / (epsilon * epsilon) + std::sin(x)),
                      std::abs(derivative / epsilon - std::cos(x))};
  };
  const auto coarse = errors(0.4), fine = errors(0.2);
  for (int i = 0; i < 2; ++i) {
    BOOST_TEST(std::abs(std::log2(coarse[i] / fine[i]) - K::order) < 0.05);  // measured within 0.03
  }
  // Leading terms: eps^2 / 8, eps^4 / 96, eps^6 / 1536 of the Laplacian; eps^2 / 4, eps^4 / 32, eps^6 / 384.
  const double eps = std::pow(0.2, K::order);
  const double of_laplacian = K::order == 2 ? 8.0 : K::order == 4 ? 96.0 : 1536.0;
  const double of_derivative = K::order == 2 ? 4.0 : K::order == 4 ? 32.0 : 384.0;
  BOOST_TEST(std::abs(fine[0] / (eps / of_laplacian * std::sin(0.7)) - 1.0) < 0.02);
  BOOST_TEST(std::abs(fine[1] / (eps / of_derivative * std::cos(0.7)) - 1.0) < 0.02);
}

/// Relative error of int x_1^2 eta = 2 as a lattice of spacing h sees it, within the cutoff.
template <class K, int D>
double lattice_floor(double h) {
  const int n = static_cast<int>(K::cutoff / h) + 1;
  double sum = 0.0;
  for (int i = -n; i <= n; ++i) {
    for (int j = -n; j <= n; ++j) {
      for (int k = D > 2 ? -n : 0; k <= (D > 2 ? n : 0); ++k) {
        const double rho2 = h * h * (i * i + j * j + k * k);
        if (rho2 < K::cutoff * K::cutoff) sum += K::template laplacian<D>(rho2) * i * i;
      }
    }
  }
  return std::abs(sum * std::pow(h, D + 2) / 2.0 - 1.0);
}

// Documented: 4e-4 and 6e-4 at the largest spacing, 8e-2 and 5e-2 at that of the Gaussian of the same order.
BOOST_AUTO_TEST_CASE(floor_of_the_algebraic_kernel) {
  BOOST_TEST((lattice_floor<Algebraic2, 2>(Algebraic2::largest_spacing)) < 4e-4);
  BOOST_TEST((lattice_floor<Algebraic2, 3>(Algebraic2::largest_spacing)) < 7e-4);
  BOOST_TEST((lattice_floor<Algebraic2, 2>(0.8)) > 8e-2);
  BOOST_TEST((lattice_floor<Algebraic2, 3>(0.8)) > 4e-2);
  // The same sum of the Gaussian shows its floor, as in 1D.
  BOOST_TEST(std::abs(lattice_floor<Gaussian2, 3>(0.8) - lattice_floor<Gaussian2, 2>(0.8)) < 1e-6);
  BOOST_TEST(std::abs(lattice_floor<Gaussian2, 2>(0.8) - 1.2e-5) < 1e-6);
}

BOOST_AUTO_TEST_CASE(algebraic_kernel) {
  BOOST_TEST(std::abs(Algebraic2::zeroth_moment<2> - 5.6568542495) < 1e-10);
  BOOST_TEST(std::abs(Algebraic2::zeroth_moment<3> - 7.4164078650) < 1e-10);
  BOOST_TEST(std::abs(Algebraic2::laplacian<2>(1.0) - 8.0 / (pi * pi)) < 1e-15);
  BOOST_TEST(std::abs(Algebraic2::laplacian<3>(1.0) - 7.5 / (pi * pi)) < 1e-15);
  // int x_i^2 eta = 2 less what lies outside the cutoff, 2 (1 - 2 R^-4 / pi) and 2 (1 - 2 R^-5 / pi).
  const double two =
      support::radial_integral<2>([](double r) { return r * r * Algebraic2::laplacian<2>(r * r); }, 10.0);
  const double three =
      support::radial_integral<3>([](double r) { return r * r * Algebraic2::laplacian<3>(r * r); }, 10.0);
  BOOST_TEST(std::abs(two / 2.0 - 2.0 * (1.0 - 2.0e-4 / pi)) < 2e-6);
  BOOST_TEST(std::abs(three / 3.0 - 2.0 * (1.0 - 2.0e-5 / pi)) < 2e-6);
}

BOOST_AUTO_TEST_CASE(largest_euler_step_is_the_limit) {
  BOOST_TEST(std::abs(largest_euler_step<Gaussian2, 2>(0.5, 0.1) - 0.01) < 1e-17);        // eps^2 / (2 D)
  BOOST_TEST(std::abs(largest_euler_step<Gaussian4, 3>(0.5, 0.1) - 0.005) < 1e-17);       // eps^2 / (4 D)
  BOOST_TEST(std::abs(largest_euler_step<Gaussian6, 1>(0.5, 0.1) - 0.01 / 3.0) < 1e-17);  // eps^2 / (6 D)
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    BOOST_CHECK_THROW((largest_euler_step<Gaussian2, 2>(bad, 0.1)), ValueError);
    BOOST_CHECK_THROW((largest_euler_step<Gaussian2, 2>(1.0, bad)), ValueError);
  }
}
