// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include <cambium/multigrid/level.hpp>

namespace cambium::detail {

/// One line of values for each worker.
template <class T>
using Lines = std::vector<AlignedVector<T>>;

/// Runs that one piece of a transfer takes.
inline constexpr std::size_t transfer_runs = 8;

/// b of the coarse level := 4 times the residual of the fine one, averaged with weights (1/4, 1/2, 1/4)^D: equations
/// are times h^2. Node i of the coarse level is node 2 i of the fine one.
template <class T, int D, Execution E>
void restrict_residual(Level<T, D>& fine, Level<T, D>& coarse, Lines<T>& lines, const E& execution) {
  fine.grid.continue_values(fine.r.data(), execution);
  constexpr int rows = D == 1 ? 1 : D == 2 ? 3 : 9;
  const auto& runs = coarse.unknowns;
  for_each_piece_by_worker(execution, runs.size(), transfer_runs,
                           [&](std::size_t worker, std::size_t b, std::size_t e) {
                             T* __restrict line = lines[worker].data();
                             for (std::size_t k = b; k < e; ++k) {
                               const Run<D>& run = runs[k];
                               const T* const middle = fine.r.data() + fine.grid.at(run.node * std::ptrdiff_t{2}) - 1;
                               const std::ptrdiff_t length = 2 * run.count + 1;
                               for (int row = 0; row < rows; ++row) {
                                 T weight(4);
                                 const T* from = middle;
                                 for (int d = 1, rest = row; d < D; ++d, rest /= 3) {
                                   from += (rest % 3 - 1) * fine.grid.stride[d];
                                   weight *= rest % 3 == 1 ? T(0.5) : T(0.25);
                                 }
                                 if (row == 0) {
                                   for (std::ptrdiff_t i = 0; i < length; ++i) line[i] = weight * from[i];
                                 } else {
                                   for (std::ptrdiff_t i = 0; i < length; ++i) line[i] += weight * from[i];
                                 }
                               }
                               T* const to = coarse.b.data() + run.at;
                               for (std::ptrdiff_t i = 0; i < run.count; ++i) {
                                 to[i] = T(0.5) * line[2 * i + 1] + T(0.25) * (line[2 * i] + line[2 * i + 2]);
                               }
                             }
                           });
}

/// x of the fine level += x of the coarse one, interpolated linearly along each axis.
template <class T, int D, Execution E>
void add_correction(Level<T, D>& coarse, Level<T, D>& fine, Lines<T>& lines, const E& execution) {
  coarse.grid.continue_values(coarse.x.data(), execution);
  const auto& runs = fine.unknowns;
  for_each_piece_by_worker(execution, runs.size(), transfer_runs,
                           [&](std::size_t worker, std::size_t b, std::size_t e) {
                             T* __restrict line = lines[worker].data();
                             for (std::size_t k = b; k < e; ++k) {
                               const Run<D>& run = runs[k];
                               Index<D> node;
                               for (int d = 0; d < D; ++d) node[d] = run.node[d] / 2;
                               const T* const source = coarse.x.data() + coarse.grid.at(node);
                               const std::ptrdiff_t length = (run.node[0] + run.count) / 2 - node[0] + 1;
                               T weight(1);
                               for (int d = 1; d < D; ++d) weight *= run.node[d] % 2 ? T(0.5) : T(1);
                               std::fill_n(line, length, T(0));
                               for (int corner = 0; corner < 1 << (D - 1); ++corner) {
                                 const T* from = source;
                                 bool twice = false;
                                 for (int d = 1; d < D; ++d) {
                                   if ((corner >> (d - 1)) % 2 == 0) continue;
                                   from += coarse.grid.stride[d];
                                   twice = twice || run.node[d] % 2 == 0;
                                 }
                                 if (twice) continue;
                                 for (std::ptrdiff_t i = 0; i < length; ++i) line[i] += weight * from[i];
                               }
                               T* const x = fine.x.data() + run.at;
                               const std::ptrdiff_t odd = run.node[0] % 2;
                               for (std::ptrdiff_t i = odd; i < run.count; i += 2) x[i] += line[(i + odd) / 2];
                               for (std::ptrdiff_t i = 1 - odd; i < run.count; i += 2) {
                                 const std::ptrdiff_t left = (i + odd) / 2;
                                 x[i] += T(0.5) * (line[left] + line[left + 1]);
                               }
                             }
                           });
}

/// Nodes and weights of interpolation from the coarse level to the nodes of the fine one along one axis: of degree 3,
/// or less where the axis has fewer nodes.
class CubicAxis {
 public:
  template <int D>
  CubicAxis(const LevelGrid<D>& coarse, const LevelGrid<D>& fine, int axis) {
    const std::ptrdiff_t n = coarse.nodes[axis];
    const bool faces = coarse.given_faces(axis);
    for (std::ptrdiff_t i = 0; i < fine.nodes[axis]; ++i) {
      Entry entry;
      const std::ptrdiff_t left = i / 2;
      if (i % 2 == 0) {
        entry.node[0] = left;
        entry.weight[0] = 1.0;
      } else if (faces && (n < 4)) {
        entry = {{left, left + 1, left, left}, {0.5, 0.5, 0.0, 0.0}};
      } else if (faces && left == 0) {
        entry = {{0, 1, 2, 3}, {0.3125, 0.9375, -0.3125, 0.0625}};
      } else if (faces && left == n - 2) {
        entry = {{n - 1, n - 2, n - 3, n - 4}, {0.3125, 0.9375, -0.3125, 0.0625}};
      } else {
        entry = {{left - 1, left, left + 1, left + 2}, {-0.0625, 0.5625, 0.5625, -0.0625}};
      }
      for (std::ptrdiff_t& node : entry.node) node = continued(coarse, axis, node);
      entries_.push_back(entry);
    }
  }
  struct Entry {
    std::array<std::ptrdiff_t, 4> node{};
    std::array<double, 4> weight{};
  };
  const Entry& operator[](std::ptrdiff_t i) const { return entries_[static_cast<std::size_t>(i)]; }

 private:
  template <int D>
  static std::ptrdiff_t continued(const LevelGrid<D>& grid, int axis, std::ptrdiff_t i) {
    const std::ptrdiff_t n = grid.nodes[axis];
    if (grid.periodic[axis]) return (i % n + n) % n;
    i = i < 0 ? -i : i;
    return i > n - 1 ? 2 * (n - 1) - i : i;
  }
  std::vector<Entry> entries_;
};

/// x of the fine level := x of the coarse one, interpolated with degree 3 along each axis, at its unknowns.
template <class T, int D, Execution E>
void interpolate_solution(const Level<T, D>& coarse, Level<T, D>& fine, const std::vector<CubicAxis>& axes,
                          const E& execution) {
  constexpr int taps = D == 1 ? 1 : D == 2 ? 4 : 16;
  const auto& runs = fine.unknowns;
  for_each_piece(execution, runs.size(), transfer_runs, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Run<D>& run = runs[k];
      std::array<const T*, taps> row;
      std::array<T, taps> weight;
      for (int tap = 0; tap < taps; ++tap) {
        Index<D> node;
        double product = 1.0;
        for (int d = 1, rest = tap; d < D; ++d, rest /= 4) {
          const CubicAxis::Entry& entry = axes[static_cast<std::size_t>(d)][run.node[d]];
          node[d] = entry.node[static_cast<std::size_t>(rest % 4)];
          product *= entry.weight[static_cast<std::size_t>(rest % 4)];
        }
        row[static_cast<std::size_t>(tap)] = coarse.x.data() + coarse.grid.at(node);
        weight[static_cast<std::size_t>(tap)] = static_cast<T>(product);
      }
      for (std::ptrdiff_t i = 0; i < run.count; ++i) {
        const CubicAxis::Entry& entry = axes[0][run.node[0] + i];
        T sum{};
        for (std::size_t tap = 0; tap < taps; ++tap) {
          T along{};
          for (std::size_t m = 0; m < 4; ++m) along += static_cast<T>(entry.weight[m]) * row[tap][entry.node[m]];
          sum += weight[tap] * along;
        }
        fine.x[run.at + static_cast<std::size_t>(i)] = sum;
      }
    }
  });
}

}  // namespace cambium::detail
