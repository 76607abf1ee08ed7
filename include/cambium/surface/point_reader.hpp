// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <cambium/levelset/narrow_band.hpp>
#include <cambium/parallel/execution.hpp>
#include <cambium/surface/cell_stencil.hpp>
#include <cambium/surface/group_values.hpp>

namespace cambium::detail {

/// Any points on an interface, sorted by the group of a surface band whose stencils reach them.
template <class Stencil, class T, int D>
class PointReader {
 public:
  using Plan = SheetPlan<T, D>;
  using Values = GroupValues<Stencil, T, D>;
  using Cell = CellStencil<typename Stencil::Kernel, T, D>;

  /// Finds the stencil of every point: that of its cell and sheet or, in cells that have none, of the nearest one.
  /// \param point   point(q): in spacings from the first node of the lattice
  /// \param normal  normal(q): outward, of any length but zero; tells the sheet
  /// \throws BandError if a point is further than `most_cells` cells from the interface
  template <class Point, class Normal, Execution E>
  void locate(const Plan& plan, std::size_t count, Point&& point, Normal&& normal, const E& execution) {
    anchor_.resize(count);
    for (auto& column : place_) column.resize(count);
    for_each(execution, count, [&](std::size_t q) { find(plan, q, point(q), normal(q)); });
    begin_.assign(plan.groups.size() + 1, 0);
    for (const std::int32_t a : anchor_) ++begin_[group_of(plan, a) + 1];
    for (std::size_t g = 0; g < plan.groups.size(); ++g) begin_[g + 1] += begin_[g];
    next_.assign(begin_.begin(), begin_.end() - 1);
    order_.resize(count);
    for (std::size_t q = 0; q < count; ++q) order_[next_[group_of(plan, anchor_[q])]++] = q;
  }
  /// Calls f(worker, group, begin, end) for every group with points, which are order(begin), ..., order(end - 1).
  template <Execution E, class F>
  void for_each_group(const E& execution, F&& f) const {
    for_each_piece_by_worker(execution, begin_.size() - 1, 1, [&](std::size_t w, std::size_t g, std::size_t) {
      if (begin_[g] < begin_[g + 1]) f(w, g, begin_[g], begin_[g + 1]);
    });
  }
  std::size_t order(std::size_t i) const { return order_[i]; }
  /// The stencil of point q.
  Cell stencil(const Plan& plan, std::size_t q) const {
    const auto& anchor = plan.anchors[static_cast<std::size_t>(anchor_[q])];
    const auto& group = plan.groups[static_cast<std::size_t>(anchor.group)];
    return Cell(anchor.in_patch, plan.of(place_, q), Values::stride_of(group));
  }

 private:
  /// Cells around that of a point in which its sheet is looked for.
  static constexpr std::ptrdiff_t most_cells = 3;

  static std::size_t group_of(const Plan& plan, std::int32_t anchor) {
    return static_cast<std::size_t>(plan.anchors[static_cast<std::size_t>(anchor)].group);
  }
  void find(const Plan& plan, std::size_t q, const Vec<D>& point, const Vec<D>& normal) {
    Index<D> cell;
    SheetPoint<T, D> at;
    for (int d = 0; d < D; ++d) {
      const double floor = std::floor(point[d]);
      cell[d] = static_cast<std::ptrdiff_t>(floor);
      at.point[d] = static_cast<T>(point[d] - floor);
      at.normal[d] = static_cast<T>(normal[d]);
    }
    at.normal /= norm(at.normal);
    for (std::ptrdiff_t around = 0; around <= most_cells; ++around) {
      if (find(plan, q, cell, at, around, true)) return;
    }
    for (std::ptrdiff_t around = 0; around <= most_cells; ++around) {
      if (find(plan, q, cell, at, around, false)) return;
    }
    throw BandError(message("point ", point, " (in spacings) is further than ", most_cells,
                            " cells from the interface that the values are on: take shorter steps"));
  }
  /// The anchor whose cell is nearest to a point, of the cells up to `around` from its own.
  bool find(const Plan& plan, std::size_t q, const Index<D>& cell, const SheetPoint<T, D>& at, std::ptrdiff_t around,
            bool same_sheet) {
    T best = static_cast<T>(2 * most_cells);
    const Index<D> size = Index<D>::constant(2 * around + 1);
    for (std::ptrdiff_t k = 0; k < product(size); ++k) {
      Index<D> there;
      SheetPoint<T, D> from = at;
      std::ptrdiff_t rest = k;
      T outside{};
      bool exists = true;
      for (int d = 0; d < D; ++d) {
        const std::ptrdiff_t step = rest % size[d] - around;
        rest /= size[d];
        there[d] = plan.first_anchor->lattice().wrap(d, cell[d] + step);
        exists &= there[d] >= 0 && there[d] < plan.first_anchor->lattice().nodes()[d];
        from.point[d] -= static_cast<T>(step);
        outside = std::max({outside, -from.point[d], from.point[d] - T(1)});
      }
      if (!exists || outside >= best) continue;
      for (std::int32_t a = (*plan.first_anchor)(there); a >= 0; a = plan.anchors[static_cast<std::size_t>(a)].next) {
        if (same_sheet && !plan.anchors[static_cast<std::size_t>(a)].point.same_sheet(from)) continue;
        anchor_[q] = a;
        for (int d = 0; d < D; ++d) place_[d][q] = from.point[d];
        best = outside;
        break;
      }
    }
    return best < static_cast<T>(2 * most_cells);
  }

  std::vector<std::int32_t> anchor_;
  std::array<AlignedVector<T>, D> place_;  ///< from the first node of the anchor's cell
  std::vector<std::size_t> begin_, next_, order_;
};

}  // namespace cambium::detail
