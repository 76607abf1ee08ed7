// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>

#include <cambium/multigrid/coarse_solver.hpp>
#include <cambium/multigrid/smoother.hpp>
#include <cambium/multigrid/transfer.hpp>

namespace cambium::detail {

/// How a cycle works.
struct CycleShape {
  int before = 1;          ///< smoothings before the coarse level
  int after = 1;           ///< and after it
  bool symmetric = false;  ///< smooth backwards after it: the cycle is a symmetric operator
};

/// Levels from fine to coarse, and the cycles over them.
template <int D, class S, class T, Execution E>
class Hierarchy {
 public:
  /// Unknowns up to which a level is solved directly without a coarser one, and beyond which it must not be.
  static constexpr std::ptrdiff_t few_unknowns = 200;
  static constexpr std::ptrdiff_t most_unknowns = 20000;

  Hierarchy(const S& smoother, const E& execution) : smoother_(smoother), execution_(execution) {}

  std::vector<Level<T, D>>& levels() { return levels_; }
  Level<T, D>& finest() { return levels_.front(); }
  const Level<T, D>& finest() const { return levels_.front(); }

  /// To be called when the levels are complete. \throws LatticeError if the last is too large
  void settle(bool singular) {
    if (levels_.back().count > most_unknowns) {
      throw LatticeError(message("the coarsest level of multigrid has ", levels_.back().count, " unknowns (",
                                 levels_.back().grid.nodes,
                                 " nodes): choose numbers of cells that can be halved more often"));
    }
    for (auto& level : levels_) level.take_arrays();
    std::ptrdiff_t longest = 0;
    for (int d = 0; d < D; ++d) longest = std::max(longest, finest().grid.nodes[d]);
    lines_.assign(static_cast<std::size_t>(execution_.count()),
                  AlignedVector<T>(static_cast<std::size_t>(longest + 4)));
    coarse_.emplace(levels_.back(), singular);
    axes_.clear();
    for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
      auto& axes = axes_.emplace_back();
      for (int d = 0; d < D; ++d) axes.emplace_back(levels_[l + 1].grid, levels_[l].grid, d);
    }
  }

  /// Improves x of level l, whose b is set.
  void cycle(const CycleShape& shape, std::size_t l = 0) {
    Level<T, D>& level = levels_[l];
    if (l + 1 == levels_.size()) {
      // The residual of zero is the right-hand side with the values of given faces in it.
      for_each_unknown(level, Serial{}, [&](std::size_t at, std::size_t) { level.x[at] = T(0); });
      find_residual(level, Serial{});
      (*coarse_)(level);
      return;
    }
    for (int k = 0; k < shape.before; ++k) smoother_(level, false, execution_);
    find_residual(level, execution_);
    Level<T, D>& coarse = levels_[l + 1];
    restrict_residual(level, coarse, lines_, execution_);
    std::fill(coarse.x.begin(), coarse.x.end(), T(0));
    cycle(shape, l + 1);
    add_correction(coarse, level, lines_, execution_);
    for (int k = 0; k < shape.after; ++k) smoother_(level, shape.symmetric, execution_);
  }

  /// Full multigrid: solves on the coarsest level, and on each finer one interpolates and cycles once. b and the given
  /// faces of x of the finest level are set.
  void full_cycle(const CycleShape& shape) {
    for (std::size_t l = 0; l + 1 < levels_.size(); ++l) inject(levels_[l], levels_[l + 1]);
    cycle(shape, levels_.size() - 1);
    for (std::size_t l = levels_.size() - 1; l-- > 0;) {
      interpolate_solution(levels_[l + 1], levels_[l], axes_[l], execution_);
      cycle(shape, l);
    }
  }

 private:
  /// Right-hand side, and values at given faces, at the nodes that both levels have.
  void inject(const Level<T, D>& fine, Level<T, D>& coarse) {
    const LevelGrid<D>& grid = coarse.grid;
    for_each_row<D>(Index<D>{}, grid.nodes - Index<D>::constant(1), [&](const Index<D>& node) {
      const std::size_t from = fine.grid.at(node * std::ptrdiff_t{2});
      const std::size_t to = grid.at(node);
      for (std::size_t i = 0; i < static_cast<std::size_t>(grid.nodes[0]); ++i) {
        coarse.x[to + i] = fine.x[from + 2 * i];
        coarse.b[to + i] = T(4) * fine.b[from + 2 * i];
      }
    });
  }
  S smoother_;
  E execution_;
  std::vector<Level<T, D>> levels_;
  Lines<T> lines_;
  std::optional<CoarseSolver> coarse_;
  std::vector<std::vector<CubicAxis>> axes_;
};

}  // namespace cambium::detail
