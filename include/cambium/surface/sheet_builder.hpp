// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>

#include <cambium/surface/sheet_plan.hpp>
#include <cambium/surface/sheet_points.hpp>
#include <cambium/surface/stencil_box.hpp>

namespace cambium::detail {

/// Unfolds the neighbourhood of an interface: finds all values (node, sheet) that the stencils at the closest points of
/// these values read, and no others.
///
/// It starts from the nodes next to the interface. The first point on a sheet in a cell of the lattice is an anchor: it
/// asks for all nodes of the stencils in its cell, each with its closest point on the anchor's sheet; their points may
/// lie in new cells, and so on until none is new. A node between two sheets thus has a value for each of them.
/// \tparam Stencil  see SurfaceLaplacian
template <class Stencil, class K, class T, int D>
class SheetBuilder {
 public:
  using Band = NarrowBand<T, D>;
  using Point = SheetPoint<T, D>;
  using Plan = SheetPlan<T, D>;
  using Box = StencilBox<Stencil, D>;
  static constexpr std::ptrdiff_t before = Box::before;
  static constexpr std::ptrdiff_t reach = Box::reach;
  static constexpr std::ptrdiff_t edge = Box::edge;

  SheetBuilder(std::type_identity<Stencil>, const Band& band, const ClosestPoints<K, T, D>& points)
      : lattice_(band.lattice()),
        band_(band),
        points_(band, points),
        first_value_(lattice_, none),
        first_anchor_(lattice_, none),
        first_group_(lattice_, none) {
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      for (std::size_t i = 0; i < Band::volume; ++i) {
        if (!points.found(b, i) || dot(points.offset(b, i), points.offset(b, i)) > T(D)) continue;
        const Index<D> node = band.values().node(b, i);
        if (lattice_.contains(node)) add(node, points_.nearest(b, i));
      }
    }
    for (std::size_t k = 0; k < values_.size(); ++k) values_[k].anchor = anchor_of(k);
  }

  /// Moves the result into `plan`, whose memory serves again.
  void write(Plan& plan) {
    number_values();
    plan.groups.clear();
    plan.entry.clear();
    plan.source.clear();
    plan.largest_patch = 0;
    const std::size_t size = values_.size();
    plan.node.resize(size);
    for (auto* columns : {&plan.offset, &plan.normal, &plan.place}) {
      for (auto& column : *columns) column.resize(size);
    }
    // Places are read by whole vectors.
    for (auto& column : plan.place) column.resize(size + 16, T(0));
    std::size_t first = 0;
    for (std::size_t g = 0; g < groups_.size(); ++g) first = write_group(plan, g, first);
    plan.anchors.swap(anchors_);
    plan.first_anchor.emplace(std::move(first_anchor_));
    plan.second_sheets = second_sheets_;
    plan.folded = folded_;
  }

 private:
  static constexpr std::int32_t none = -1;

  struct Value {
    Index<D> node;
    Point point;  ///< relative to the node
    std::int32_t next;
    std::int32_t anchor = none;
  };
  using Anchor = typename Plan::Anchor;
  struct Group {
    Index<D> block;
    std::int32_t next;
    std::vector<std::int32_t> anchors;
    std::vector<std::int32_t> table;  ///< value at each entry of the patch of the block, or none
    std::size_t values = 0;
  };

  /// The lattice's name of a node. \throws InterfaceError if it lies behind a bounded face
  Index<D> wrapped(Index<D> node) const {
    for (int d = 0; d < D; ++d) {
      node[d] = lattice_.wrap(d, node[d]);
      if (node[d] >= 0 && node[d] < lattice_.nodes()[d]) continue;
      throw InterfaceError(message("stencils of the interface reach node ", node, " behind a face of axis ", d,
                                   " of the box: enlarge the box or make that axis periodic"));
    }
    return node;
  }
  std::int32_t add(const Index<D>& node, const Point& point) {
    const auto k = static_cast<std::int32_t>(values_.size());
    values_.push_back({node, point, first_value_(node), none});
    first_value_.set(node, k);
    return k;
  }
  static Index<D> cell_of(const Vec<D, T>& offset, const Index<D>& node, Vec<D, T>& inside) {
    Index<D> cell;
    for (int d = 0; d < D; ++d) {
      const T floor = std::floor(offset[d]);
      cell[d] = node[d] + static_cast<std::ptrdiff_t>(floor);
      inside[d] = offset[d] - floor;
    }
    return cell;
  }
  /// The anchor of the closest point of value k, a new one if need be.
  std::int32_t anchor_of(std::size_t k) {
    Point point = values_[k].point;
    const Index<D> cell = wrapped(cell_of(values_[k].point.point, values_[k].node, point.point));
    for (std::int32_t a = first_anchor_(cell); a != none; a = anchors_[static_cast<std::size_t>(a)].next) {
      if (anchors_[static_cast<std::size_t>(a)].point.same_sheet(point)) return a;
    }
    const auto a = static_cast<std::int32_t>(anchors_.size());
    anchors_.push_back({cell, {}, point, first_anchor_(cell), none});
    first_anchor_.set(cell, a);
    const Index<D> block = Numbers::block_of(cell);
    const std::size_t shift = Box::entry_of(cell - block * BlockShape<D>::extent);
    const std::int32_t group = first_group_(block);
    for (std::size_t n = 0; n < box_.size(); ++n) {
      const auto known = group == none ? none : groups_[static_cast<std::size_t>(group)].table[shift + box_[n].entry];
      found_[n] = resolve(cell + box_[n].step, moved(point, box_[n].step), known);
    }
    anchors_.back().group = join_group(cell, a);
    return a;
  }
  /// A point relative to another node, `step` further.
  static Point moved(Point point, const Index<D>& step) {
    for (int d = 0; d < D; ++d) point.point[d] -= static_cast<T>(step[d]);
    return point;
  }
  /// The value of a node on the sheet of a point, which is relative to the node. \param guess  a value of the node that
  /// may be the one, or none
  std::int32_t resolve(const Index<D>& at, const Point& sheet, std::int32_t guess) {
    if (guess != none && sheet.same_sheet(values_[static_cast<std::size_t>(guess)].point)) return guess;
    const Index<D> node = wrapped(at);
    const std::int32_t known = first_value_(node);
    for (std::int32_t k = known; k != none; k = values_[static_cast<std::size_t>(k)].next) {
      if (sheet.same_sheet(values_[static_cast<std::size_t>(k)].point)) return k;
    }
    const auto nearest = points_.nearest(node);
    if (nearest && sheet.same_sheet(*nearest)) return add(node, *nearest);
    if (const auto point = points_.on_sheet(node, sheet)) {
      if (nearest) ++second_sheets_;
      return add(node, *point);
    }
    ++folded_;
    if (known != none) return known;
    if (nearest) return add(node, *nearest);
    return add(node, sheet);
  }
  /// The first group of the cell's block whose patch has no other values at the entries of the anchor takes it.
  std::int32_t join_group(const Index<D>& cell, std::int32_t anchor) {
    const Index<D> block = Field<T, D, Sparse>::block_of(cell);
    const std::size_t shift = Box::entry_of(cell - block * BlockShape<D>::extent);
    std::int32_t first = first_group_(block);
    std::int32_t g = first;
    const auto fits = [&](const Group& group) {
      for (std::size_t n = 0; n < box_.size(); ++n) {
        const std::int32_t there = group.table[shift + box_[n].entry];
        if (there != none && there != found_[n]) return false;
      }
      return true;
    };
    while (g != none && !fits(groups_[static_cast<std::size_t>(g)])) g = groups_[static_cast<std::size_t>(g)].next;
    if (g == none) {
      g = static_cast<std::int32_t>(groups_.size());
      const auto entries = static_cast<std::size_t>(product(Index<D>::constant(edge)));
      groups_.push_back({block, first, {}, std::vector<std::int32_t>(entries, none)});
      first_group_.set(block, g);
    }
    groups_[static_cast<std::size_t>(g)].anchors.push_back(anchor);
    auto& table = groups_[static_cast<std::size_t>(g)].table;
    for (std::size_t n = 0; n < box_.size(); ++n) table[shift + box_[n].entry] = found_[n];
    return g;
  }

  std::size_t group_of(std::size_t k) const {
    return static_cast<std::size_t>(anchors_[static_cast<std::size_t>(values_[k].anchor)].group);
  }
  /// order_: values by group and, in a group, by node; number_: the inverse.
  void number_values() {
    order_.resize(values_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::vector<std::pair<std::size_t, std::size_t>> key(values_.size());
    for (std::size_t k = 0; k < values_.size(); ++k) {
      key[k] = {group_of(k), lattice_.number(values_[k].node)};
      ++groups_[group_of(k)].values;
    }
    std::sort(order_.begin(), order_.end(),
              [&](std::size_t a, std::size_t b) { return key[a] != key[b] ? key[a] < key[b] : a < b; });
    number_.resize(values_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) number_[order_[k]] = static_cast<std::int32_t>(k);
  }
  std::size_t write_group(Plan& plan, std::size_t g, std::size_t first) {
    const Group& group = groups_[g];
    Index<D> low = Index<D>::constant(edge), high{};
    for_each_entry(group, [&](const Index<D>& at, std::size_t) {
      for (int d = 0; d < D; ++d) {
        low[d] = std::min(low[d], at[d]);
        high[d] = std::max(high[d], at[d] + 1);
      }
    });
    typename Plan::Group to{first, group.values, plan.entry.size(),
                            0,     high - low,   high - low - Index<D>::constant(2 * reach)};
    for_each_entry(group, [&](const Index<D>& at, std::size_t entry) {
      std::ptrdiff_t compact = 0;
      for (int d = D - 1; d >= 0; --d) compact = compact * to.edge[d] + at[d] - low[d];
      plan.entry.push_back(static_cast<std::uint16_t>(compact));
      plan.source.push_back(number_[static_cast<std::size_t>(group.table[entry])]);
    });
    to.entries = plan.entry.size() - to.first_entry;
    plan.largest_patch = std::max(plan.largest_patch, static_cast<std::size_t>(product(to.edge)));
    for (std::size_t k = first; k < first + group.values; ++k) write_value(plan, k, group.block, low);
    for (const std::int32_t a : group.anchors) {
      Anchor& anchor = anchors_[static_cast<std::size_t>(a)];
      anchor.in_patch = in_patch(anchor.cell, group.block, low);
    }
    plan.groups.push_back(to);
    return first + group.values;
  }
  void write_value(Plan& plan, std::size_t k, const Index<D>& block, const Index<D>& low) const {
    const Value& value = values_[order_[k]];
    const Index<D>& cell = anchors_[static_cast<std::size_t>(value.anchor)].cell;
    Vec<D, T> inside;
    cell_of(value.point.point, value.node, inside);
    plan.node[k] = value.node;
    const Index<D> first = in_patch(cell, block, low);
    for (int d = 0; d < D; ++d) {
      plan.offset[d][k] = value.point.point[d];
      plan.normal[d][k] = value.point.normal[d];
      plan.place[d][k] = static_cast<T>(first[d]) + inside[d];
    }
  }
  static Index<D> in_patch(const Index<D>& cell, const Index<D>& block, const Index<D>& low) {
    return cell - block * BlockShape<D>::extent + Index<D>::constant(before + reach) - low;
  }
  template <class F>
  void for_each_entry(const Group& group, F&& f) const {
    for (std::size_t entry = 0; entry < group.table.size(); ++entry) {
      if (group.table[entry] == none) continue;
      Index<D> at;
      auto rest = static_cast<std::ptrdiff_t>(entry);
      for (int d = 0; d < D; ++d, rest /= edge) at[d] = rest % edge;
      f(at, entry);
    }
  }

  using Numbers = Field<std::int32_t, D, Sparse>;

  Lattice<D> lattice_;
  const Band& band_;
  SheetPoints<K, T, D> points_;
  Numbers first_value_, first_anchor_, first_group_;  ///< by node; by first node of the cell; by index of the block
  std::vector<Value> values_;
  std::vector<Anchor> anchors_;
  std::vector<Group> groups_;
  Box box_;
  std::array<std::int32_t, Box::most> found_{};
  std::vector<std::size_t> order_;
  std::vector<std::int32_t> number_;
  std::size_t second_sheets_ = 0;
  std::size_t folded_ = 0;
};

}  // namespace cambium::detail
