// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE aggregation_cycle
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>
#include <span>

#include <cambium/interface/aggregation_cycle.hpp>

using namespace cambium;

namespace {

using Cells = detail::FiniteVolumes<double, 2>;
using Cycle = detail::AggregationCycle<2, OpenMP>;

/// Cells of a rectangle that is closed or periodic: every face between two of them is open.
Cells rectangle(const Index<2>& nodes, double mass, bool periodic = false) {
  Cells cells(detail::LevelGrid<2>(nodes, {periodic, periodic}, {}));
  for (std::ptrdiff_t j = 0; j < nodes[1]; ++j) {
    for (std::ptrdiff_t i = 0; i < nodes[0]; ++i) {
      const std::size_t at = cells.grid.at({i, j});
      cells.mass[at] = mass;
      if (periodic || i + 1 < nodes[0]) cells.face[0][at] = 1.0;
      if (periodic || j + 1 < nodes[1]) cells.face[1][at] = 1.0;
    }
  }
  cells.settle(Serial{});
  return cells;
}

/// Calls f(entry) for all cells, without the images that periodic axes have.
template <class F>
void each(const Cells& cells, F&& f) {
  cells.for_each_row(Serial{}, [&](const Index<2>&, std::size_t start) {
    for (std::size_t at = start; at < start + static_cast<std::size_t>(cells.grid.nodes[0]); ++at) f(at);
  });
}
AlignedVector<double> noise(const Cells& cells, unsigned seed) {
  std::mt19937 random(seed);
  AlignedVector<double> values(cells.grid.size(), 0.0);
  each(cells, [&](std::size_t at) { values[at] = std::uniform_real_distribution<>(-1.0, 1.0)(random); });
  return values;
}
AlignedVector<double> answer(Cycle& cycle, const AlignedVector<double>& b) {
  std::ranges::transform(b, cycle.finest().b.begin(), [](double value) { return static_cast<float>(value); });
  cycle();
  return {cycle.finest().x.begin(), cycle.finest().x.end()};
}
double product(const Cells& cells, const AlignedVector<double>& a, const AlignedVector<double>& b) {
  double sum = 0.0;
  each(cells, [&](std::size_t at) { sum += a[at] * b[at]; });
  return sum;
}

/// What a cycle leaves of the error of A x = 0, in the norm of A, when as many have been that it no longer changes.
double factor(const Index<2>& nodes, double mass, bool periodic = false) {
  const Cells cells = rectangle(nodes, mass, periodic);
  Cycle cycle{OpenMP{}};
  cycle.take(cells);
  auto x = noise(cells, 1), r = x;
  const auto energy = [&] {
    cells.grid.continue_values(x.data(), Serial{});
    each(cells, [&](std::size_t at) { r[at] = cells.diagonal(at) * x[at] - cells.of_neighbours(at, x.data()); });
    return std::sqrt(product(cells, x, r));
  };
  double before = energy(), result = 0.0;
  for (int k = 0; k < 20; ++k) {
    const auto change = answer(cycle, r);
    each(cells, [&](std::size_t at) { x[at] -= change[at]; });
    const double now = energy();
    result = now / before;
    // As single precision is relative to what is left, so that small numbers do not matter.
    each(cells, [&](std::size_t at) { x[at] /= now; });
    before = energy();
  }
  return result;
}

}  // namespace

// Measured 0.59 to 0.64, whatever the lattice, with odd numbers of cells or even ones. A coarse mass or coefficient
// that is wrong, or cells that a correction leaves out, make it 0.67 to above 1.
BOOST_AUTO_TEST_CASE(a_cycle_leaves_as_much_on_any_lattice) {
  for (const double mass : {1e-6, 1e-2}) {
    for (const std::ptrdiff_t n : {16, 32, 64, 128}) {
      const double even = factor({n, n}, mass), odd = factor({n + 1, n - 1}, mass);
      BOOST_TEST_MESSAGE(n << " cells, mass " << mass << ": " << even << ", odd " << odd);
      BOOST_TEST(even < 0.66);
      BOOST_TEST(odd < 0.66);
    }
  }
  const double periodic = factor({33, 31}, 1e-2, true);
  BOOST_TEST_MESSAGE("periodic, odd: " << periodic);
  BOOST_TEST(periodic < 0.66);
}

// Of a constant, which all levels must find together: measured 0.9987 with two visits of the coarser level, 0.90 with
// one.
BOOST_AUTO_TEST_CASE(corrections_have_the_right_size) {
  const Cells cells = rectangle({64, 64}, 1e-2);
  Cycle cycle{OpenMP{}};
  cycle.take(cells);
  AlignedVector<double> x(cells.grid.size(), 1.0), b = x;
  each(cells, [&](std::size_t at) { b[at] = cells.mass[at]; });  // a constant is the answer
  const auto of_b = answer(cycle, b);
  const double share = product(cells, of_b, b) / product(cells, x, b);
  BOOST_TEST_MESSAGE("of a constant, a cycle finds " << share);
  BOOST_TEST(std::abs(share - 1.0) < 0.01);
}

// Conjugate gradients need it. Round-off of single precision: measured 4e-6; 7e-4 where smoothing
// after the correction has the colours in the wrong order.
BOOST_AUTO_TEST_CASE(a_cycle_is_symmetric) {
  const Cells cells = rectangle({37, 22}, 1e-3);
  Cycle cycle{OpenMP{}};
  cycle.take(cells);
  const auto a = noise(cells, 2), b = noise(cells, 3);
  const auto of_a = answer(cycle, a), of_b = answer(cycle, b);
  const double left = product(cells, b, of_a), right = product(cells, a, of_b);
  const double scale = std::sqrt(product(cells, a, of_a) * product(cells, b, of_b));
  BOOST_TEST_MESSAGE("asymmetry " << std::abs(left - right) / scale);
  BOOST_TEST(std::abs(left - right) < 5e-5 * scale);
}

BOOST_AUTO_TEST_CASE(threads_do_not_change_a_bit) {
  const Cells cells = rectangle({90, 131}, 1e-3);
  const auto b = noise(cells, 4);
  const auto run = [&](int threads) {
    Cycle cycle{OpenMP{threads}};
    cycle.take(cells);
    return answer(cycle, b);
  };
  const auto one = run(1);
  for (const int threads : {2, 3}) BOOST_TEST(std::ranges::equal(one, run(threads)));
}
