// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE krylov
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>
#include <tuple>

#include <cambium/multigrid/krylov.hpp>
#include <cambium/multigrid/multigrid.hpp>

using namespace cambium;

namespace {

template <class Loop, class S, bool Symmetric>
struct Case {
  using Krylov = Loop;
  using Smoothing = S;
  static constexpr bool symmetric = Symmetric;
};
using Cases = std::tuple<Case<ConjugateGradient, Chebyshev<2>, true>, Case<ConjugateGradient, RedBlack, true>,
                         Case<BiCGStab, RedBlack, false>, Case<GMRES<8>, RedBlack, false>>;

std::vector<double> noise(std::size_t size) {
  std::vector<double> values(size);
  std::mt19937 random(3);
  for (double& value : values) value = std::uniform_real_distribution<>(-1.0, 1.0)(random);
  return values;
}
std::span<const double> constant(const std::vector<double>& values) { return values; }

/// Largest difference between both sides of A x = b, relative to the largest of b.
template <class Solver>
double residual(Solver& solver, const std::vector<double>& x, const std::vector<double>& b) {
  std::vector<double> image(x.size());
  solver.apply(x.data(), image.data());
  double worst = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    worst = std::max(worst, std::abs(image[i] - b[i]));
    largest = std::max(largest, std::abs(b[i]));
  }
  return worst / largest;
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(multigrid_preconditions, C, Cases) {
  using Solver = Multigrid<3, typename C::Smoothing, double>;
  typename Solver::Params params;
  params.symmetric = C::symmetric;
  Solver multigrid(Lattice<3>::bounded_box(Box<3>::cube(), 16), params);
  const auto apply = [&](const double* in, double* out) { multigrid.apply(in, out); };
  const auto cycle = [&](const double* in, double* out) { multigrid.precondition(in, out); };
  const auto same = [&](const double* in, double* out) { std::copy_n(in, multigrid.unknowns(), out); };
  const auto b = noise(multigrid.unknowns());
  std::vector<double> x(b.size()), plain(b.size());
  const SolveReport report = solve_krylov<typename C::Krylov, double>(apply, cycle, constant(b), std::span(x));
  BOOST_CHECK_LT(residual(multigrid, x, b), 1e-6);
  BOOST_TEST(report.residuals.size() > 1U);
  BOOST_TEST(report.iterations <= 12);
  const auto without =
      solve_krylov<typename C::Krylov, double>(apply, same, constant(b), std::span(plain), {1e-8, 1000});
  BOOST_TEST(without.iterations > 2 * report.iterations);
  // From the solution there is nothing left to do.
  const auto again = solve_krylov<typename C::Krylov, double>(apply, cycle, constant(b), std::span(x), {1e-6, 5});
  BOOST_TEST(again.iterations <= 1);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_symmetric_cycle_is_one, C, Cases) {
  using Solver = Multigrid<2, typename C::Smoothing, double>;
  typename Solver::Params params;
  params.symmetric = C::symmetric;
  Solver multigrid(Lattice<2>::bounded_box(Box<2>::cube(), 32), params);
  const std::size_t size = multigrid.unknowns();
  const auto a = noise(size);
  std::vector<double> b(size), ma(size), mb(size);
  for (std::size_t i = 0; i < size; ++i) b[i] = std::cos(0.1 * static_cast<double>(i * i % 101));
  multigrid.precondition(a.data(), ma.data());
  multigrid.precondition(b.data(), mb.data());
  double left = 0.0, right = 0.0, scale = 0.0;
  for (std::size_t i = 0; i < size; ++i) {
    left += a[i] * mb[i];
    right += b[i] * ma[i];
    scale += std::abs(a[i] * mb[i]);
  }
  if (C::symmetric) {
    BOOST_CHECK_LT(std::abs(left - right), 1e-12 * scale);
  } else {
    BOOST_CHECK_GT(std::abs(left - right), 1e-6 * scale);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_loop_that_does_not_end_is_told, C, Cases) {
  using Solver = Multigrid<2, RedBlack, double>;
  Solver multigrid(Lattice<2>::bounded_box(Box<2>::cube(), 32));
  const auto apply = [&](const double* in, double* out) { multigrid.apply(in, out); };
  const auto same = [&](const double* in, double* out) { std::copy_n(in, multigrid.unknowns(), out); };
  const auto b = noise(multigrid.unknowns());
  auto x = noise(multigrid.unknowns());
  const auto before = x;
  const auto solve = [&] {
    solve_krylov<typename C::Krylov, double>(apply, same, constant(b), std::span(x), {1e-10, 4});
  };
  BOOST_CHECK_EXCEPTION(solve(), ConvergenceError, [](const ConvergenceError& e) {
    return e.residuals().size() >= 2 && e.residuals().back() > 1e-10;
  });
  BOOST_TEST(x == before);
  std::vector<double> few(3);
  const auto mismatch = [&] { solve_krylov<typename C::Krylov, double>(apply, same, constant(b), std::span(few)); };
  BOOST_CHECK_THROW(mismatch(), SizeError);
}
