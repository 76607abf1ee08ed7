// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <utility>
#include <vector>

#include <cambium/levelset/curved_element.hpp>
#include <cambium/levelset/interface_cells.hpp>
#include <cambium/parallel/compensated_sum.hpp>

namespace cambium::detail {

/// Sums over the cells of one block that the interface cuts; lengths in spacings.
template <int D>
struct BlockIntegral {
  CompensatedSum area;
  Moments<D> inside;           ///< positions from the first node of the lattice, behind the cut of periodic axes
  std::size_t unresolved = 0;  ///< points of elements that no projection reached: the element is flat there
  std::vector<std::pair<Index<D>, Index<D>>> joins;             ///< nodes inside, connected across a face
  std::vector<std::pair<std::uint32_t, std::uint32_t>> shared;  ///< crossings of one piece of the interface
};

/// Integrates over the cells that the interface cuts: flat elements fill the cell exactly (CellMoments), curved ones on
/// top of them bring the order (CurvedElement).
template <class K, class T, int D>
class InterfaceIntegral {
 public:
  explicit InterfaceIntegral(const InterfaceCells<K, T, D>& cells) : cells_(cells) {}

  /// \param begin  where each periodic axis is cut open: cells before it count as being one period further
  template <Execution E>
  std::vector<BlockIntegral<D>> operator()(const Index<D>& begin, const E& execution) const {
    std::vector<BlockIntegral<D>> sums(cells_.cut_blocks());
    cells_.for_each_cell(execution, [&](std::size_t k, const Index<D>& node, const Patch<T, D>& patch,
                                        const CutCell<D>& cell, int inside, const auto& number) {
      Vec<D> corner;
      for (int d = 0; d < D; ++d) {
        corner[d] = static_cast<double>(node[d] + (node[d] < begin[d] ? cells_.band().lattice().nodes()[d] : 0));
      }
      Moments<D> moments = CellMoments<D>::of(cell, inside);
      add_elements(patch, node - patch.first(), cell, moments, sums[k]);
      sums[k].inside += moments.moved(corner);
      connect(node, cell, number, sums[k]);
    });
    return sums;
  }

 private:
  static void add_elements(const Patch<T, D>& patch, const Index<D>& corner, const CutCell<D>& cell,
                           Moments<D>& moments, BlockIntegral<D>& sums) {
    using Element = CurvedElement<D>;
    const InterfaceProjection<K, T, D> projection(patch);
    const auto project = [&](const Vec<D>& x) {
      Vec<D, T> y;
      for (int d = 0; d < D; ++d) y[d] = static_cast<T>(x[d] + static_cast<double>(corner[d]));
      if (!projection(y)) {
        ++sums.unresolved;
        return x;
      }
      Vec<D> result;
      for (int d = 0; d < D; ++d) result[d] = static_cast<double>(y[d]) - static_cast<double>(corner[d]);
      return result;
    };
    // Triangles of one cell share their diagonals.
    std::array<std::array<int, 2>, CutCell<D>::most_elements * Element::sides> known;
    std::array<Vec<D>, CutCell<D>::most_elements * Element::sides> above;
    int count = 0;
    const auto above_side = [&](int a, int b) {
      if (a > b) std::swap(a, b);
      for (int s = 0; s < count; ++s) {
        if (known[s][0] == a && known[s][1] == b) return above[s];
      }
      known[count] = {a, b};
      above[count] = project((cell.point[a] + cell.point[b]) * 0.5);
      return above[count++];
    };
    for (int e = 0; e < cell.elements; ++e) {
      typename Element::Nodes x;
      Vec<D> middle{};
      for (int v = 0; v < D; ++v) middle += x[v] = cell.point[cell.element[e][v]];
      for (int s = 0; s < Element::sides; ++s) {
        x[D + s] = above_side(cell.element[e][Element::side[s][0]], cell.element[e][Element::side[s][1]]);
      }
      if constexpr (D == 3) x[6] = project(middle / 3.0);
      sums.area += Element::add_gap(x, moments);
    }
  }
  template <class Numbers>
  static void connect(const Index<D>& node, const CutCell<D>& cell, const Numbers& number, BlockIntegral<D>& sums) {
    for (int e = 0; e < cell.elements; ++e) {
      // A vertex in the middle of a cell is the first of its elements.
      sums.shared.emplace_back(number[cell.element[e][D - 2]], number[cell.element[e][D - 1]]);
      if (D == 3 && cell.edge[cell.element[e][0]] >= 0) {
        sums.shared.emplace_back(number[cell.element[e][0]], number[cell.element[e][1]]);
      }
    }
    for (int j = 0; j < cell.joins; ++j) {
      const auto at = [&](int corner) {
        Index<D> result = node;
        for (int d = 0; d < D; ++d) result[d] += corner >> d & 1;
        return result;
      };
      sums.joins.emplace_back(at(cell.join[j][0]), at(cell.join[j][1]));
    }
  }

  const InterfaceCells<K, T, D>& cells_;
};

}  // namespace cambium::detail
