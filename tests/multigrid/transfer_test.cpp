// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE transfer
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>
#include <tuple>

#include <cambium/multigrid/transfer.hpp>

using namespace cambium;

namespace {

enum class Ends { given, mirror, periodic, disk };

template <int D, Ends K>
struct Case {
  static constexpr int dimension = D;
  static constexpr Ends ends = K;
};
using Cases = std::tuple<Case<2, Ends::given>, Case<2, Ends::mirror>, Case<2, Ends::periodic>, Case<2, Ends::disk>,
                         Case<3, Ends::given>, Case<3, Ends::mirror>, Case<3, Ends::periodic>, Case<3, Ends::disk>>;

/// A level of a box, or of the nodes of a ball in it.
template <class C>
detail::Level<double, C::dimension> level_of(std::ptrdiff_t cells) {
  constexpr int D = C::dimension;
  std::array<bool, D> periodic{};
  periodic.fill(C::ends == Ends::periodic);
  std::array<Wall, D> walls{};
  walls.fill(C::ends == Ends::mirror ? Wall::neumann : Wall::dirichlet);
  const auto nodes = Index<D>::constant(cells + (C::ends == Ends::periodic ? 0 : 1));
  detail::Level<double, D> level(detail::LevelGrid<D>(nodes, periodic, walls));
  take_whole_box(level);
  if (C::ends == Ends::disk) {
    const auto boxes = level.unknowns;
    level.unknowns.clear();
    for (const auto& run : boxes) {
      double across = 0.0;
      const double n = static_cast<double>(cells);
      for (int d = 1; d < D; ++d) across += std::pow(static_cast<double>(run.node[d]) / n - 0.47, 2);
      if (across > 0.16) continue;
      const double half = std::sqrt(0.16 - across);
      Index<D> node = run.node;
      node[0] = static_cast<std::ptrdiff_t>(std::ceil((0.51 - half) * n));
      const auto end = static_cast<std::ptrdiff_t>(std::floor((0.51 + half) * n));
      level.unknowns.push_back(make_run(level.grid, node, end - node[0] + 1, 0));
    }
    level.regular = level.unknowns;
  }
  level.take_arrays();
  return level;
}

/// Nodes on walls that mirror count half along each axis: they stand for half a cell.
template <int D>
double weight_of(const detail::LevelGrid<D>& grid, const Index<D>& node) {
  double weight = 1.0;
  for (int d = 0; d < D; ++d) {
    if (!grid.periodic[d] && (node[d] == 0 || node[d] == grid.nodes[d] - 1)) weight *= 0.5;
  }
  return weight;
}

template <int D, class F>
void each(const detail::Level<double, D>& level, F&& f) {
  for (const auto& run : level.unknowns) {
    Index<D> node = run.node;
    for (std::ptrdiff_t i = 0; i < run.count; ++i, ++node[0]) f(run.at + static_cast<std::size_t>(i), node);
  }
}

}  // namespace

// R = 4 / 2^D P^T: the factor 4 is that of equations times h^2, and the weights of linear interpolation add up to 2^D.
BOOST_AUTO_TEST_CASE_TEMPLATE(restriction_is_the_adjoint_of_interpolation, C, Cases) {
  constexpr int D = C::dimension;
  auto fine = level_of<C>(16);
  auto coarse = level_of<C>(8);
  std::mt19937 random(7);
  std::uniform_real_distribution<> any(-1.0, 1.0);
  each(fine, [&](std::size_t at, const Index<D>&) { fine.r[at] = any(random); });
  each(coarse, [&](std::size_t at, const Index<D>&) { coarse.x[at] = any(random); });
  detail::Lines<double> lines(1, AlignedVector<double>(64));
  restrict_residual(fine, coarse, lines, Serial{});
  add_correction(coarse, fine, lines, Serial{});
  double above = 0.0, below = 0.0, scale = 0.0;
  each(fine, [&](std::size_t at, const Index<D>& node) {
    above += weight_of(fine.grid, node) * fine.r[at] * fine.x[at];
    scale += std::abs(fine.r[at] * fine.x[at]);
  });
  each(coarse, [&](std::size_t at, const Index<D>& node) {
    below += weight_of(coarse.grid, node) * coarse.b[at] * coarse.x[at];
  });
  const double factor = 4.0 / (1 << D);
  BOOST_CHECK_GT(scale, 1.0);
  BOOST_CHECK_LT(std::abs(below - factor * above), 1e-14 * scale);
}

// Which fixes the weights that the adjoint shares. Where walls mirror every node has all its neighbours.
using Whole = std::tuple<Case<2, Ends::mirror>, Case<3, Ends::mirror>>;
BOOST_AUTO_TEST_CASE_TEMPLATE(linear_functions_are_interpolated_exactly, C, Whole) {
  constexpr int D = C::dimension;
  auto fine = level_of<C>(16);
  auto coarse = level_of<C>(8);
  const auto plane = [](const Index<D>& node, double h) {
    double sum = 1.0;
    for (int d = 0; d < D; ++d) sum += (d + 1) * h * static_cast<double>(node[d]);
    return sum;
  };
  each(coarse, [&](std::size_t at, const Index<D>& node) { coarse.x[at] = plane(node, 2.0); });
  detail::Lines<double> lines(1, AlignedVector<double>(64));
  add_correction(coarse, fine, lines, Serial{});
  each(fine, [&](std::size_t at, const Index<D>& node) {
    BOOST_TEST_REQUIRE(std::abs(fine.x[at] - plane(node, 1.0)) < 1e-12);
  });
}
