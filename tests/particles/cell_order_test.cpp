// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE cell_order
#include <boost/test/unit_test.hpp>
#include <limits>
#include <random>
#include <string>
#include <tuple>
#include <utility>

#include <cambium/particles/cell_order.hpp>

using namespace cambium;

namespace {

template <int D, class T>
struct Case {
  static constexpr int dimension = D;
  using Scalar = T;
};
using Cases = std::tuple<Case<1, double>, Case<2, double>, Case<3, double>, Case<2, float>, Case<3, float>>;

/// [-0.5, 1.5]^D, axis 0 bounded, the others periodic.
template <int D>
Domain<D> mixed() {
  Domain<D> domain = Domain<D>::periodic_box({Vec<D>::constant(-0.5), Vec<D>::constant(1.5)});
  domain.periodic[0] = false;
  return domain;
}

template <int D, class T>
Particles<D, T> scatter(const Domain<D>& domain, std::size_t count) {
  std::mt19937_64 random(count);
  std::uniform_real_distribution<double> unit(-0.5, 1.49999);
  std::uniform_int_distribution<int> image(-2, 2);
  Particles<D, T> particles(count);
  for (std::size_t p = 0; p < count; ++p) {
    Vec<D, T> x;
    for (int d = 0; d < D; ++d) x[d] = static_cast<T>(unit(random) + (domain.periodic[d] ? 2 * image(random) : 0));
    particles.positions().set(p, x);
  }
  return particles;
}

/// Cell of a position by definition: floor of the wrapped distance from lo in cells.
template <int D, class T>
std::size_t cell_of(const CellGrid<D>& grid, const Vec<D, T>& x) {
  Index<D> cell;
  for (int d = 0; d < D; ++d) {
    const double extent = grid.domain().box.extent()[d];
    double u = static_cast<double>(x[d]) - grid.domain().box.lo[d];
    if (grid.domain().periodic[d]) u -= extent * std::floor(u / extent);
    cell[d] = static_cast<std::ptrdiff_t>(u / extent * static_cast<double>(grid.cells()[d]));
    if (cell[d] == grid.cells()[d]) --cell[d];  // the upper face
  }
  std::ptrdiff_t number = 0;
  for (int d = D - 1; d >= 0; --d) number = number * grid.cells()[d] + cell[d];
  return static_cast<std::size_t>(number);
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(order_is_that_of_a_stable_sort, C, Cases) {
  constexpr int D = C::dimension;
  using T = typename C::Scalar;
  const Domain<D> domain = mixed<D>();
  CellOrder<D> order;  // one object for all: buffers are reused, growing and shrinking
  // From one cell to many more cells than particles and than the 1024 buckets of the first pass. The sizes are not
  // commensurable with the box, so that no particle sits on a cell face where the two formulas may round differently.
  for (const double size : {3.0, 0.37, 0.017, D == 3 ? 0.013 : 0.0013}) {
    for (const std::size_t count : {0, 1, 1000, 30000}) {
      const CellGrid<D> grid(domain, size);
      const Particles<D, T> particles = scatter<D, T>(domain, count);
      order.sort(grid, particles.positions(), OpenMP{2});
      BOOST_TEST(order.size() == count);
      std::vector<std::uint32_t> expected(count);
      std::vector<std::size_t> cell(count);
      for (std::size_t p = 0; p < count; ++p) {
        expected[p] = static_cast<std::uint32_t>(p);
        cell[p] = cell_of(grid, particles.positions()[p]);
      }
      const auto key = [&](auto p) { return std::pair(cell[p], p); };
      std::sort(expected.begin(), expected.end(), [&](auto a, auto b) { return key(a) < key(b); });
      BOOST_TEST(std::equal(expected.begin(), expected.end(), order.order().begin(), order.order().end()));

      std::vector<std::uint32_t> starts(grid.size() + 1, 0);
      for (const std::size_t c : cell) ++starts[c + 1];
      for (std::size_t c = 0; c < grid.size(); ++c) starts[c + 1] += starts[c];
      BOOST_TEST(std::equal(starts.begin(), starts.end(), order.starts().begin(), order.starts().end()));
    }
  }
}

BOOST_AUTO_TEST_CASE(order_does_not_depend_on_threads) {
  const Domain<3> domain = mixed<3>();
  const Particles<3> particles = scatter<3, double>(domain, 100000);
  for (const double size : {0.5, 0.04}) {
    const CellGrid<3> grid(domain, size);
    CellOrder<3> serial;
    serial.sort(grid, particles.positions(), Serial{});
    for (int threads = 1; threads <= 4; ++threads) {
      CellOrder<3> order;
      order.sort(grid, particles.positions(), OpenMP{threads});
      BOOST_TEST(std::equal(serial.order().begin(), serial.order().end(), order.order().begin(), order.order().end()));
      BOOST_TEST(
          std::equal(serial.starts().begin(), serial.starts().end(), order.starts().begin(), order.starts().end()));
    }
  }
}

BOOST_AUTO_TEST_CASE(reordering_moves_every_array) {
  const Domain<2> domain = mixed<2>();
  Particles<2> particles = scatter<2, double>(domain, 5000);
  const auto number = particles.add<double>("number");
  const auto pair = particles.add<Vec<2, float>>("pair");
  for (std::size_t p = 0; p < particles.size(); ++p) {
    particles[number][p] = static_cast<double>(p);
    particles[pair].set(p, {static_cast<float>(p), -static_cast<float>(p)});
  }
  const Particles<2> before = particles;
  CellOrder<2> order;
  for (int turn = 0; turn < 2; ++turn) {  // the second time all is in order already
    order.sort(CellGrid<2>(domain, 0.1), particles.positions());
    order.reorder(particles);
    std::size_t last = 0;
    for (std::size_t s = 0; s < particles.size(); ++s) {
      const auto p = static_cast<std::size_t>(particles[number][s]);
      if (turn == 0) BOOST_TEST(p == order.order()[s]);
      if (turn == 1) BOOST_TEST(order.order()[s] == s);
      BOOST_TEST((particles.positions()[s] == before.positions()[p]));
      BOOST_TEST((particles[pair][s] == before[pair][p]));
      const std::size_t cell = order.grid().number(particles.positions()[s]);
      BOOST_TEST(cell >= last);
      BOOST_TEST((order.starts()[cell] <= s && s < order.starts()[cell + 1]));
      last = cell;
    }
  }
}

BOOST_AUTO_TEST_CASE(buffers_are_reused) {
  const Domain<2> domain = mixed<2>();
  Particles<2> particles = scatter<2, double>(domain, 3000);
  CellOrder<2> order;
  order.sort(CellGrid<2>(domain, 0.1), particles.positions());
  const auto* first = order.order().data();
  const auto* starts = order.starts().data();
  order.sort(CellGrid<2>(domain, 0.11), particles.positions());
  BOOST_TEST(order.order().data() == first);
  BOOST_TEST(order.starts().data() == starts);
}

BOOST_AUTO_TEST_CASE(bad_input_changes_nothing) {
  const Domain<2> domain = mixed<2>();
  const CellGrid<2> grid(domain, 0.25);
  Particles<2> particles = scatter<2, double>(domain, 20000);
  const auto mass = particles.add<double>("mass", 1.0);
  CellOrder<2> order;
  order.sort(grid, particles.positions());
  const std::vector<std::uint32_t> kept(order.order().begin(), order.order().end());
  const auto refuses = [&](std::size_t p, const Vec<2>& x, const std::string& part) {
    const Vec<2> sound = particles.positions()[p];
    particles.positions().set(p, x);
    BOOST_CHECK_EXCEPTION(order.sort(grid, particles.positions(), OpenMP{2}), PositionError, [&](const Error& error) {
      return std::string(error.what()).find(part) != std::string::npos;
    });
    BOOST_TEST(std::equal(kept.begin(), kept.end(), order.order().begin(), order.order().end()));
    particles.positions().set(p, sound);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuses(7000, {1.6, 0.0}, "particle 7000 at (1.6000000000000001, 0) is outside the bounded box (-0.5, -0.5)");
  refuses(7000, {-0.6, 0.0}, "along axis 0: enlarge the box or remove the particle");
  refuses(19999, {0.0, nan}, "particle 19999 has position (0, nan): component 1 is not finite");
  refuses(0, {-std::numeric_limits<double>::infinity(), 0.0}, "particle 0 has position (-inf, 0)");
  particles.positions().set(12000, {nan, 0.0});
  refuses(3000, {nan, 0.0}, "particle 3000 ");  // of several, the first

  Particles<2> fewer(3);
  BOOST_CHECK_EXCEPTION(order.reorder(fewer), SizeError, [](const Error& error) {
    return std::string(error.what()).find("particles has 3 entries where 20000 are needed") != std::string::npos;
  });
  std::vector<double> out(3, -1.0);
  const Particles<2>& view = particles;
  BOOST_CHECK_THROW(order.gather(view[mass], std::span<double>(out)), SizeError);
  BOOST_TEST(out[0] == -1.0);
}
