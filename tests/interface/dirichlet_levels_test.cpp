// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE dirichlet_levels
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <support/count_allocations.hpp>
#include <tuple>

#include <cambium/interface/dirichlet.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/multigrid/chebyshev.hpp>

using namespace cambium;

namespace {

template <int D>
struct Oval {
  double scale = 1.0;
  double operator()(const Vec<D>& x) const {
    const double half[3] = {0.37, 0.25, 0.3};
    double sum = 0.0;
    for (int d = 0; d < D; ++d) sum += std::pow((x[d] - 0.5 - 0.003 * d) / (scale * half[d]), 2);
    return 0.3 * (std::sqrt(sum) - 1.0);
  }
};

template <int D>
LevelSet<ClosestPoint, D> oval(std::ptrdiff_t cells, double scale = 1.0) {
  return {Lattice<D>::bounded_box(Box<D>::cube(), cells), Oval<D>{scale}, {}, Serial{}};
}

template <int D, class S>
struct Case {
  static constexpr int dimension = D;
  using Smoothing = S;
};
using Cases = std::tuple<Case<2, RedBlack>, Case<2, Chebyshev<2>>, Case<3, RedBlack>, Case<3, Chebyshev<2>>>;

/// What is left of the residual of the irregular equations after a cycle V(1,1), once the first cycles are over.
template <int D, class S>
double factor(std::ptrdiff_t cells) {
  const auto level_set = oval<D>(cells);
  detail::DirichletLevels<D, S, Serial> levels(level_set.band().lattice(), {}, S{}, Serial{});
  levels.update(level_set.band(), Side::inside, 0.0);
  auto& level = levels.hierarchy().finest();
  for_each_unknown(level, Serial{}, [&](std::size_t at, std::size_t i) {
    level.x[at] = static_cast<float>(std::cos(0.7 * static_cast<double>(i * i % 101)));  // the solution is 0
  });
  const auto norm = [&] {
    find_residual(level, Serial{});
    double sum = 0.0;
    for_each_unknown(level, Serial{}, [&](std::size_t at, std::size_t) { sum += std::pow(double(level.r[at]), 2); });
    return std::sqrt(sum);
  };
  for (int k = 0; k < 4; ++k) levels.hierarchy().cycle({1, 1, false});
  const double before = norm();
  for (int k = 0; k < 4; ++k) levels.hierarchy().cycle({1, 1, false});
  return std::pow(norm() / before, 0.25);
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(a_cycle_takes_as_much_away_on_any_lattice, C, Cases) {
  constexpr int D = C::dimension;
  const std::ptrdiff_t finest = D == 2 ? 256 : 96;
  for (std::ptrdiff_t cells = finest / 4; cells <= finest; cells *= 2) {
    const double left = factor<D, typename C::Smoothing>(cells);
    BOOST_TEST_MESSAGE(D << "D " << cells << " cells: " << left);
    BOOST_CHECK_LT(left, D == 2 ? 0.15 : 0.25);
  }
}

// Steps of growth: the interface goes to and fro, and comes back to where there was room for its equations.
BOOST_AUTO_TEST_CASE(solutions_take_no_memory) {
  std::vector<LevelSet<ClosestPoint, 3>> level_sets;
  for (const double scale : {1.06, 1.0}) level_sets.push_back(oval<3>(32, scale));
  const auto& lattice = level_sets[0].band().lattice();
  Dirichlet<3, double, BiCGStab, RedBlack, Serial> dirichlet(level_sets[1].band(), {}, Serial{});
  const Field<double, 3> f(lattice, 1.0);
  Field<double, 3> c(lattice);
  Field<double, 3, Sparse> derivative(lattice);
  std::size_t solving = 0, bytes = 0, after = 0;
  for (int step = 0; step < 4; ++step) {
    const auto& level_set = level_sets[step % 2];
    dirichlet.update(level_set.band());
    const std::size_t start = support::allocations, start_bytes = support::allocated_bytes;
    dirichlet.solve(
        f, [](const Vec<3>& x) { return x[0]; }, c);
    solving = support::allocations - start;
    bytes = support::allocated_bytes - start_bytes;
    dirichlet.continue_beyond(c, 2);
    const std::size_t between = support::allocations;
    dirichlet.normal_derivative(level_set.band(), level_set.method().points(), c, derivative);
    after = support::allocations - between;
  }
  // Nothing is left of the interface before: a new object finds the same bits.
  Dirichlet<3, double, BiCGStab, RedBlack, Serial> fresh(level_sets[1].band(), {}, Serial{});
  Field<double, 3> again(lattice), expected(lattice);
  for (auto* solver : {&fresh, &dirichlet}) {
    solver->solve(
        f, [](const Vec<3>& x) { return x[0]; }, solver == &fresh ? expected : again);
  }
  BOOST_TEST(std::ranges::equal(again.values(), expected.values()));
  BOOST_TEST(solving == support::counted(1));  // the residuals of the report
  BOOST_TEST(bytes < 2000U);
  BOOST_TEST(after == 0U);
}
