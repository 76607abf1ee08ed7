// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>

#include <cambium/multigrid/level.hpp>

namespace cambium::detail {

/// Balances of cells: mass u - sum over faces of open (u_neighbour - u) = b, on one level.
///
/// Entries are those of LevelGrid. face[d] is the coefficient of the face to the next node along axis d; a node without
/// an open face is no unknown.
template <class T, int D>
struct FiniteVolumes {
  explicit FiniteVolumes(const LevelGrid<D>& level_grid) : grid(level_grid) {
    for (auto& f : face) f.assign(grid.size(), T(0));
    for (auto* array : {&mass, &x, &b, &inverse}) array->assign(grid.size(), T(0));
  }

  LevelGrid<D> grid;
  std::array<AlignedVector<T>, D> face;
  AlignedVector<T> mass;     ///< s h^2 times the share of the cell
  AlignedVector<T> inverse;  ///< of the diagonal; 0 where there is no unknown
  AlignedVector<T> x, b;

  std::size_t rows() const { return static_cast<std::size_t>(product(grid.nodes) / grid.nodes[0]); }
  /// The first node of row r.
  Index<D> row(std::size_t r) const {
    Index<D> node{};
    auto rest = static_cast<std::ptrdiff_t>(r);
    for (int d = 1; d < D; ++d) {
      node[d] = rest % grid.nodes[d];
      rest /= grid.nodes[d];
    }
    return node;
  }
  /// Calls f(first node of the row, its entry) for all rows.
  template <Execution E, class F>
  void for_each_row(const E& execution, F&& f) const {
    for_each_piece(execution, rows(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = begin; r < end; ++r) {
        const Index<D> node = row(r);
        f(node, grid.at(node));
      }
    });
  }

  T diagonal(std::size_t at) const { return mass[at] + open(at); }
  /// Sum of the coefficients of the faces of a cell.
  T open(std::size_t at) const {
    T sum(0);
    for (int d = 0; d < D; ++d) sum += face[d][at] + face[d][at - static_cast<std::size_t>(grid.stride[d])];
    return sum;
  }
  /// Sum over the neighbours of coefficient times value.
  T of_neighbours(std::size_t at, const T* value) const {
    T sum(0);
    for (int d = 0; d < D; ++d) {
      const auto step = static_cast<std::size_t>(grid.stride[d]);
      sum += face[d][at] * value[at + step] + face[d][at - step] * value[at - step];
    }
    return sum;
  }
  /// To be called when coefficients are complete: those before the first node of periodic axes, and the diagonal.
  template <Execution E>
  void settle(const E& execution) {
    for (int d = 0; d < D; ++d) {
      if (!grid.periodic[d]) continue;
      const auto period = static_cast<std::size_t>(grid.stride[d] * grid.nodes[d]);
      for_each_row(Serial{}, [&](const Index<D>& first, std::size_t start) {
        if (d > 0 && first[d] != grid.nodes[d] - 1) return;
        const auto step = static_cast<std::size_t>(d == 0 ? grid.nodes[0] - 1 : 0);
        const auto count = static_cast<std::size_t>(d == 0 ? 1 : grid.nodes[0]);
        for (std::size_t i = 0; i < count; ++i) face[d][start + step + i - period] = face[d][start + step + i];
      });
    }
    constexpr T least = T(1e-30);  // a cell of this share has no value in single precision
    for_each_row(execution, [&](const Index<D>&, std::size_t start) {
      for (std::size_t at = start; at < start + static_cast<std::size_t>(grid.nodes[0]); ++at) {
        const T sum = diagonal(at);
        inverse[at] = sum > least ? T(1) / sum : T(0);
      }
    });
    grid.continue_values(inverse.data(), execution);
  }
  /// One Gauss-Seidel pass over the unknowns of a colour.
  template <Execution E>
  void smooth(std::ptrdiff_t colour, const E& execution) {
    grid.continue_values(x.data(), execution);
    for_each_row(execution, [&](const Index<D>& first, std::size_t start) {
      std::ptrdiff_t parity = colour;
      for (int d = 1; d < D; ++d) parity += first[d];
      for (std::ptrdiff_t i = parity % 2; i < grid.nodes[0]; i += 2) {
        const std::size_t at = start + static_cast<std::size_t>(i);
        if (inverse[at] > T(0)) x[at] = inverse[at] * (b[at] + of_neighbours(at, x.data()));
      }
    });
  }
};

}  // namespace cambium::detail
