// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <cambium/core/aligned.hpp>
#include <cambium/core/lattice.hpp>
#include <cambium/multigrid/wall.hpp>
#include <cambium/parallel/execution.hpp>

namespace cambium::detail {

/// Nodes of one level with one layer of nodes around them, which continue values across periodic faces and walls.
template <int D>
struct LevelGrid {
  Index<D> nodes;
  Index<D> stride;
  std::array<bool, D> periodic{};
  std::array<Wall, D> walls{};

  LevelGrid(const Index<D>& count, const std::array<bool, D>& periodic_axes, const std::array<Wall, D>& wall_kinds)
      : nodes(count), periodic(periodic_axes), walls(wall_kinds) {
    stride[0] = 1;
    for (int d = 1; d < D; ++d) stride[d] = stride[d - 1] * (nodes[d - 1] + 2);
  }
  std::size_t size() const { return static_cast<std::size_t>(stride[D - 1] * (nodes[D - 1] + 2)); }
  std::size_t at(const Index<D>& node) const {
    std::ptrdiff_t result = 0;
    for (int d = 0; d < D; ++d) result += (node[d] + 1) * stride[d];
    return static_cast<std::size_t>(result);
  }
  /// True if the nodes of the faces of an axis are data, not unknowns.
  bool given_faces(int d) const { return !periodic[d] && walls[d] == Wall::dirichlet; }
  Index<D> first() const {
    Index<D> node;
    for (int d = 0; d < D; ++d) node[d] = given_faces(d) ? 1 : 0;
    return node;
  }
  Index<D> last() const {
    Index<D> node;
    for (int d = 0; d < D; ++d) node[d] = nodes[d] - (given_faces(d) ? 2 : 1);
    return node;
  }

  /// Sets the layer around: opposite nodes of periodic axes, mirror images at Neumann walls. That of given faces is not
  /// touched: no stencil reads it.
  template <class T, Execution E>
  void continue_values(T* x, const E& execution) const {
    std::ptrdiff_t slabs = 1;
    for (int d = 0; d < D; ++d) {
      if (given_faces(d)) continue;
      const std::ptrdiff_t n = nodes[d];
      const std::ptrdiff_t low = periodic[d] ? n - 1 : n > 1 ? 1 : 0;
      const std::ptrdiff_t high = periodic[d] ? 0 : n > 1 ? n - 2 : 0;
      slabs = static_cast<std::ptrdiff_t>(size()) / (stride[d] * (n + 2));
      for_each_piece(execution, static_cast<std::size_t>(slabs), d == 0 ? 1024 : 16, [&](std::size_t b, std::size_t e) {
        for (auto slab = static_cast<std::ptrdiff_t>(b); slab < static_cast<std::ptrdiff_t>(e); ++slab) {
          T* const base = x + slab * stride[d] * (n + 2);
          for (std::ptrdiff_t i = 0; i < stride[d]; ++i) {
            base[i] = base[(low + 1) * stride[d] + i];
            base[(n + 1) * stride[d] + i] = base[(high + 1) * stride[d] + i];
          }
        }
      });
    }
  }
};

/// Unknowns that follow each other along axis 0.
template <int D>
struct Run {
  Index<D> node;   ///< the first
  std::size_t at;  ///< its entry in the arrays of the level
  std::ptrdiff_t count;
  std::ptrdiff_t number;  ///< of the first among all unknowns
  int colour;             ///< 0 if the sum of its indices is even
};

/// Row of an unknown next to the interface, scaled to the diagonal of all others: x - sum of leg[k] x[neighbour k] over
/// the neighbours -e_0, +e_0, -e_1, ... that are unknowns; 0 for the others.
template <class T, int D>
struct CutRow {
  std::size_t at;
  std::array<T, 2 * static_cast<std::size_t>(D)> leg{};
};

/// Difference equations diagonal x - sum of neighbours = b on one level, times h^2, and the arrays of a cycle.
///
/// Unknowns outside `regular` and `cut` stay zero, so that no stencil asks for the side of a node.
template <class T, int D>
struct Level {
  explicit Level(const LevelGrid<D>& level_grid) : grid(level_grid) {}

  /// Arrays of zeros, unless they are there.
  void take_arrays() {
    for (auto* array : {&x, &b, &r}) {
      if (array->size() != grid.size()) array->assign(grid.size(), T(0));
    }
  }
  /// Gives up all unknowns; the arrays are zero then wherever they were not on given faces or around the lattice.
  void clear() {
    for (auto* array : {&x, &b, &r}) {
      if (array->empty()) continue;
      for (const auto& run : unknowns) std::fill_n(array->data() + run.at, run.count, T(0));
    }
    unknowns.clear();
    regular.clear();
    for (auto& rows : cut) rows.clear();
    count = 0;
  }

  LevelGrid<D> grid;
  double diagonal = 2.0 * D;                     ///< 2 D + s h^2
  std::vector<Run<D>> unknowns;                  ///< all unknowns
  std::vector<Run<D>> regular;                   ///< those with the plain stencil
  std::array<std::vector<CutRow<T, D>>, 2> cut;  ///< all others, by colour
  std::ptrdiff_t count = 0;                      ///< number of unknowns
  AlignedVector<T> x, b, r;
};

template <int D, class T>
T sum_of_neighbours(const T* x, const Index<D>& stride) {
  T sum = x[-1] + x[1];
  for (int d = 1; d < D; ++d) sum += x[-stride[d]] + x[stride[d]];
  return sum;
}

template <int D, class T>
T sum_of_neighbours(const T* x, const Index<D>& stride, const CutRow<T, D>& row) {
  T sum{};
  for (std::size_t d = 0; d < D; ++d) {
    const std::ptrdiff_t step = stride[static_cast<int>(d)];
    sum += row.leg[2 * d] * x[-step] + row.leg[2 * d + 1] * x[step];
  }
  return sum;
}

/// Runs and rows that one piece of a loop takes.
inline constexpr std::size_t runs_per_piece = 32;
inline constexpr std::size_t rows_per_piece = 512;

/// r := b - A x at the unknowns.
template <class T, int D, Execution E>
void find_residual(Level<T, D>& level, const E& execution) {
  level.grid.continue_values(level.x.data(), execution);
  const Index<D> stride = level.grid.stride;
  const T diagonal = static_cast<T>(level.diagonal);
  for_each_piece(execution, level.regular.size(), runs_per_piece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Run<D>& run = level.regular[k];
      const T* const x = level.x.data() + run.at;
      const T* const b = level.b.data() + run.at;
      T* __restrict r = level.r.data() + run.at;
      for (std::ptrdiff_t i = 0; i < run.count; ++i) {
        r[i] = b[i] - diagonal * x[i] + sum_of_neighbours<D>(x + i, stride);
      }
    }
  });
  for (const auto& rows : level.cut) {
    for_each_piece(execution, rows.size(), rows_per_piece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const std::size_t at = rows[k].at;
        const T* const x = level.x.data() + at;
        level.r[at] = level.b[at] - diagonal * *x + sum_of_neighbours<D>(x, stride, rows[k]);
      }
    });
  }
}

/// Calls f(array entry, number) for the unknowns of each run.
template <class T, int D, class F, Execution E>
void for_each_unknown(const Level<T, D>& level, const E& execution, F&& f) {
  for_each_piece(execution, level.unknowns.size(), runs_per_piece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Run<D>& run = level.unknowns[k];
      for (std::ptrdiff_t i = 0; i < run.count; ++i) {
        f(run.at + static_cast<std::size_t>(i), static_cast<std::size_t>(run.number + i));
      }
    }
  });
}

/// Calls f(node, first along axis 0, last along axis 0) for the rows of all nodes from `first` to `last`.
template <int D, class F>
void for_each_row(const Index<D>& first, const Index<D>& last, F&& f) {
  Index<D> node = first;
  for (int d = 0; d < D; ++d) {
    if (last[d] < first[d]) return;
  }
  for (;;) {
    f(node);
    int d = 1;
    while (d < D && node[d] == last[d]) {
      node[d] = first[d];
      ++d;
    }
    if (d >= D) return;
    ++node[d];
  }
}

template <int D>
Run<D> make_run(const LevelGrid<D>& grid, const Index<D>& node, std::ptrdiff_t count, std::ptrdiff_t number) {
  std::ptrdiff_t sum = 0;
  for (int d = 0; d < D; ++d) sum += node[d];
  return {node, grid.at(node), count, number, static_cast<int>(sum % 2)};
}

/// Makes every node that is not on a given face an unknown with the plain stencil.
template <class T, int D>
void take_whole_box(Level<T, D>& level) {
  const Index<D> first = level.grid.first();
  const Index<D> last = level.grid.last();
  level.count = 0;
  level.unknowns.clear();
  for_each_row<D>(first, last, [&](const Index<D>& node) {
    const std::ptrdiff_t count = last[0] - first[0] + 1;
    level.unknowns.push_back(make_run(level.grid, node, count, level.count));
    level.count += count;
  });
  level.regular = level.unknowns;
}

}  // namespace cambium::detail
