// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <cambium/interface/finite_volumes.hpp>

namespace cambium::detail {

/// A multigrid cycle for balances of cells: a coarse cell is the union of 2^D, and its faces are those of its parts.
///
/// Corrections are constant in a coarse cell, sums of residuals its right-hand side. As such corrections are twice too
/// steep, the coefficients of faces are halved on each level, which makes them those of the coarse lattice (Braess
/// 1995, "Towards algebraic multigrid for elliptic problems of second order"). Two visits of the coarser level (a W
/// cycle) and smoothing red, black before and black, red after it: a symmetric operator.
template <int D, Execution E>
class AggregationCycle {
 public:
  using Level = FiniteVolumes<float, D>;

  explicit AggregationCycle(const E& execution) : execution_(execution) {}

  Level& finest() { return levels_.front(); }

  /// Takes the coefficients of the finest level.
  void take(const FiniteVolumes<double, D>& fine) {
    levels_.clear();
    Level& first = levels_.emplace_back(fine.grid);
    for (int d = 0; d < D; ++d) std::ranges::transform(fine.face[d], first.face[d].begin(), to_float);
    std::ranges::transform(fine.mass, first.mass.begin(), to_float);
    first.settle(execution_);
    while (product(levels_.back().grid.nodes) > 1) coarsen();
  }
  /// x of the finest level := the cycle's answer to its b.
  void operator()() {
    std::ranges::fill(finest().x, 0.0F);
    visit(0);
  }

 private:
  static constexpr int visits = 2;
  static float to_float(double value) { return static_cast<float>(value); }

  static Index<D> parent(Index<D> node) {
    for (int d = 0; d < D; ++d) node[d] /= 2;
    return node;
  }
  void coarsen() {
    const LevelGrid<D>& grid = levels_.back().grid;
    Index<D> nodes;
    for (int d = 0; d < D; ++d) nodes[d] = (grid.nodes[d] + 1) / 2;
    Level coarse(LevelGrid<D>(nodes, grid.periodic, grid.walls));
    const Level& fine = levels_.back();
    fine.for_each_row(Serial{}, [&](const Index<D>& first, std::size_t start) {
      Index<D> node = first;
      for (node[0] = 0; node[0] < grid.nodes[0]; ++node[0]) {
        const std::size_t at = start + static_cast<std::size_t>(node[0]);
        const std::size_t to = coarse.grid.at(parent(node));
        coarse.mass[to] += fine.mass[at];
        for (int d = 0; d < D; ++d) {
          const bool between = node[d] % 2 == 1 || node[d] == grid.nodes[d] - 1;
          if (between && nodes[d] > 1) coarse.face[d][to] += 0.5F * fine.face[d][at];
        }
      }
    });
    coarse.settle(execution_);
    levels_.push_back(std::move(coarse));
  }
  void visit(std::size_t l) {
    Level& fine = levels_[l];
    fine.smooth(0, execution_);
    fine.smooth(1, execution_);
    if (l + 1 < levels_.size()) {
      for (int k = 0; k < visits; ++k) {
        restrict_residual(l);
        std::ranges::fill(levels_[l + 1].x, 0.0F);
        visit(l + 1);
        add_correction(l);
      }
    }
    fine.smooth(1, execution_);
    fine.smooth(0, execution_);
  }
  /// Calls f(entry, entry on the coarser level) for all nodes; coarse rows are the pieces of work.
  template <class F>
  void for_each_child(std::size_t l, F&& f) {
    const LevelGrid<D>& grid = levels_[l].grid;
    const Level& coarse = levels_[l + 1];
    coarse.for_each_row(execution_, [&](const Index<D>& first, std::size_t start) {
      for (int c = 0; c < 1 << (D - 1); ++c) {
        Index<D> node{};
        bool exists = true;
        for (int d = 1; d < D; ++d) {
          node[d] = 2 * first[d] + (c >> (d - 1) & 1);
          exists = exists && node[d] < grid.nodes[d];
        }
        if (!exists) continue;
        const std::size_t at = grid.at(node);
        for (std::size_t i = 0; i < static_cast<std::size_t>(grid.nodes[0]); ++i) f(at + i, start + i / 2);
      }
    });
  }
  void restrict_residual(std::size_t l) {
    Level& fine = levels_[l];
    Level& coarse = levels_[l + 1];
    std::ranges::fill(coarse.b, 0.0F);
    fine.grid.continue_values(fine.x.data(), execution_);
    for_each_child(l, [&](std::size_t at, std::size_t to) {
      if (fine.inverse[at] == 0.0F) return;
      coarse.b[to] += fine.b[at] + fine.of_neighbours(at, fine.x.data()) - fine.x[at] / fine.inverse[at];
    });
  }
  void add_correction(std::size_t l) {
    Level& fine = levels_[l];
    const Level& coarse = levels_[l + 1];
    for_each_child(l, [&](std::size_t at, std::size_t to) {
      if (fine.inverse[at] > 0.0F) fine.x[at] += coarse.x[to];
    });
  }

  E execution_;
  std::vector<Level> levels_;
};

}  // namespace cambium::detail
