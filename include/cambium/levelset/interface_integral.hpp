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

/// Points above the sides of elements, kept for the elements on the other side: most belong to the same block.
template <int D>
class SideCache {
 public:
  /// Point above the side between crossings a and b, in spacings from entry 0 of the patch of `block`; find() calls
  /// make() if it is not known. It depends on the elements of the block alone, in their order.
  template <class Make>
  Vec<D> find(std::size_t block, std::size_t a, std::size_t b, Make&& make) {
    if (a > b) std::swap(a, b);
    Entry& entry = entries_[(a * 31 + b) % entries_.size()];
    if (entry.block != block || entry.a != a || entry.b != b) entry = {block, a, b, make()};
    return entry.point;
  }

 private:
  struct Entry {
    std::size_t block = static_cast<std::size_t>(-1);
    std::size_t a = 0, b = 0;
    Vec<D> point;
  };
  std::vector<Entry> entries_ = std::vector<Entry>(1024);
};

/// Integrates over the cells that the interface cuts: flat elements fill the cell exactly (CellMoments), curved ones on
/// top of them bring the order (CurvedElement).
template <class K, class T, int D>
class InterfaceIntegral {
 public:
  using Cells = InterfaceCells<K, T, D>;
  using Place = typename Cells::Place;

  explicit InterfaceIntegral(const Cells& cells) : cells_(cells) {}

  /// \param begin  where each periodic axis is cut open: cells before it count as being one period further
  template <Execution E>
  std::vector<BlockIntegral<D>> operator()(const Index<D>& begin, const E& execution) {
    std::vector<BlockIntegral<D>> sums(cells_.cut_blocks());
    sides_.resize(static_cast<std::size_t>(execution.count()));
    cells_.for_each_cell(execution, [&](const Place& place, const Patch<T, D>& patch, const CutCell<D>& cell) {
      BlockIntegral<D>& sum = sums[place.block];
      Vec<D> corner;
      for (int d = 0; d < D; ++d) {
        const bool before = place.node[d] < begin[d];
        corner[d] = static_cast<double>(place.node[d] + (before ? cells_.band().lattice().nodes()[d] : 0));
      }
      Moments<D> moments = CellMoments<D>::of(cell, place.inside);
      for_each_element(patch, place, cell, sum.unresolved,
                       [&](const typename Element::Nodes& x) { sum.area += Element::add_gap(x, moments); });
      sum.inside += moments.moved(corner);
      connect(place, cell, sum);
    });
    return sums;
  }
  /// Calls f(place, nodes) for every curved element; nodes from the first node of its cell, in spacings.
  template <Execution E, class F>
  void for_each_element(const E& execution, F&& f) {
    sides_.resize(static_cast<std::size_t>(execution.count()));
    cells_.for_each_cell(execution, [&](const Place& place, const Patch<T, D>& patch, const CutCell<D>& cell) {
      std::size_t unresolved = 0;
      for_each_element(patch, place, cell, unresolved, [&](const typename Element::Nodes& x) { f(place, x); });
    });
  }

 private:
  using Element = CurvedElement<D>;

  template <class F>
  void for_each_element(const Patch<T, D>& patch, const Place& place, const CutCell<D>& cell, std::size_t& unresolved,
                        F&& f) {
    Vec<D> corner;
    for (int d = 0; d < D; ++d) corner[d] = static_cast<double>(place.node[d] - patch.first()[d]);
    const auto above = [&](const Vec<D>& x) { return project(patch, x + corner, unresolved); };
    const auto above_side = [&](int a, int b) {
      const Vec<D> middle = (cell.point[a] + cell.point[b]) * 0.5;
      if (D == 2 || cell.edge[a] < 0 || cell.edge[b] < 0) return above(middle) - corner;
      const auto make = [&] { return above(middle); };
      return sides_[place.worker].find(place.block, place.number[a], place.number[b], make) - corner;
    };
    for (int e = 0; e < cell.elements; ++e) {
      const auto& v = cell.element[e];
      typename Element::Nodes x;
      for (int c = 0; c < D; ++c) x[c] = cell.point[v[c]];
      for (int s = 0; s < Element::sides; ++s) x[D + s] = above_side(v[Element::side[s][0]], v[Element::side[s][1]]);
      if constexpr (D == 3) x[6] = above((x[0] + x[1] + x[2]) / 3.0) - corner;
      f(x);
    }
  }
  /// The point on the interface next to x, or x itself if there is none.
  static Vec<D> project(const Patch<T, D>& patch, const Vec<D>& x, std::size_t& unresolved) {
    Vec<D, T> y;
    for (int d = 0; d < D; ++d) y[d] = static_cast<T>(x[d]);
    if (!InterfaceProjection<K, T, D>(patch)(y)) {
      ++unresolved;
      return x;
    }
    Vec<D> result;
    for (int d = 0; d < D; ++d) result[d] = static_cast<double>(y[d]);
    return result;
  }
  /// Notes what the elements of a cell connect.
  static void connect(const Place& place, const CutCell<D>& cell, BlockIntegral<D>& sums) {
    for (int e = 0; e < cell.elements; ++e) {
      for (int c = 1; c < D; ++c) {
        const int a = cell.element[e][c - 1], b = cell.element[e][c];
        // A vertex in the middle of a cell comes first in its elements, and they all share another one.
        if (cell.edge[a] >= 0) sums.shared.emplace_back(place.number[a], place.number[b]);
      }
    }
    for (int j = 0; j < cell.joins; ++j) {
      const auto at = [&](int corner) {
        Index<D> result = place.node;
        for (int d = 0; d < D; ++d) result[d] += corner >> d & 1;
        return result;
      };
      sums.joins.emplace_back(at(cell.join[j][0]), at(cell.join[j][1]));
    }
  }

  const Cells& cells_;
  std::vector<SideCache<D>> sides_;
};

}  // namespace cambium::detail
