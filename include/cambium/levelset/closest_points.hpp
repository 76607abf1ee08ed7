// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <cambium/kernels/hat.hpp>
#include <cambium/kernels/lambda.hpp>
#include <cambium/kernels/m4_prime.hpp>
#include <cambium/levelset/blocks_around.hpp>
#include <cambium/levelset/closest_point_search.hpp>
#include <cambium/levelset/crossings.hpp>
#include <cambium/levelset/kernel_disagreement.hpp>
#include <cambium/levelset/nearest_points.hpp>
#include <cambium/levelset/point_box.hpp>

namespace cambium {

/// How closest points were found.
struct ClosestPointCounts {
  std::size_t nodes = 0;         ///< nodes with a closest point
  std::size_t lower_order = 0;   ///< of these, by one of the lower-order kernels: the interface is under-resolved there
  std::size_t not_searched = 0;  ///< of these, by the point of a neighbour or a linear estimate: no search converged
};

/// Closest points on the interface of the nodes of a band, from phi of any scaling whose zero set is the interface.
///
/// Nodes next to the interface search from the crossings of the lattice lines; every other node from the nearest of the
/// points that these found. The search (Newton) runs on the
/// interpolant of kernel K; where it fails, on that of M4' and then of Hat.
template <class K, class T, int D>
class ClosestPoints {
 public:
  using Band = NarrowBand<T, D>;
  /// Kernel of higher order whose difference from K tells the error of K.
  using Finer = Lambda<6, 4>;

  /// \param band        values of any scaling; blocks around every node within `width` of the interface
  /// \param width       length up to which closest points are wanted
  template <Execution E>
  void find(const Band& band, double width, const E& execution) {
    width_ = static_cast<T>(width / band.spacing());
    const std::size_t size = band.blocks() * Band::volume;
    for (auto& column : offset_) column.resize(size);
    error_.resize(size);
    slope_.resize(size);
    method_.assign(size, unknown);
    if (near_jets_.size() < band.blocks()) near_jets_.resize(band.blocks());
    patches_.resize(static_cast<std::size_t>(execution.count()));
    nearest_.resize(static_cast<std::size_t>(execution.count()));
    search_near(band, execution);
    list_near(band);
    search_far(band, execution);
    count();
  }

  /// Makes the points those of a band with other blocks: block b was block came_from[b], or -1 if it has no points.
  void take_blocks(const std::vector<std::ptrdiff_t>& came_from) {
    bool same = came_from.size() * Band::volume == method_.size();
    for (std::size_t b = 0; same && b < came_from.size(); ++b) same = came_from[b] == static_cast<std::ptrdiff_t>(b);
    if (same) return;
    for (auto& column : offset_) take_blocks(column, came_from, T(0), spare_);
    take_blocks(error_, came_from, T(0), spare_);
    take_blocks(slope_, came_from, T(0), spare_);
    take_blocks(method_, came_from, unknown, spare_method_);
  }

  /// True if node i of block b has a closest point.
  bool found(std::size_t b, std::size_t i) const { return method_[b * Band::volume + i] != unknown; }
  /// Closest point minus position of the node, in spacings.
  Vec<D, T> offset(std::size_t b, std::size_t i) const { return offset_at(b * Band::volume + i); }
  /// What the closest point may be off by, in spacings: the difference between kernels.
  T error(std::size_t b, std::size_t i) const { return error_[b * Band::volume + i]; }
  /// |grad phi| at the closest point.
  T slope(std::size_t b, std::size_t i) const { return slope_[b * Band::volume + i]; }
  const ClosestPointCounts& counts() const { return counts_; }

  /// Saves or restores the points of the nodes of so many blocks, see SnapshotWriter.
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive, std::size_t blocks) {
    const std::size_t size = blocks * Band::volume;
    archive("points.width", self.width_);
    for (int d = 0; d < D; ++d) archive("points.offset." + std::to_string(d), self.offset_[d], size);
    archive("points.error", self.error_, size);
    archive("points.slope", self.slope_, size);
    archive("points.method", self.method_, size);
  }

 private:
  static constexpr std::uint8_t not_searched = 3;
  static constexpr std::uint8_t unknown = 4;
  /// Nodes next to the interface have their point within one spacing; a search may take it a little further.
  static constexpr double near_reach = 1.6;
  /// Nodes that the stencils of a search need beyond the point that it may reach.
  static constexpr std::ptrdiff_t stencil = Taps<Finer>::support / 2 + 1;

  /// Nodes that the search of a far node may stray from where it starts, tangentially.
  static constexpr std::ptrdiff_t wander = 2;

  template <class Column>
  static void take_blocks(Column& column, const std::vector<std::ptrdiff_t>& came_from,
                          typename Column::value_type absent, Column& taken) {
    taken.clear();
    taken.reserve(came_from.size() * Band::volume);
    for (const std::ptrdiff_t from : came_from) {
      if (from < 0) {
        taken.insert(taken.end(), Band::volume, absent);
      } else {
        const auto first = column.begin() + from * static_cast<std::ptrdiff_t>(Band::volume);
        taken.insert(taken.end(), first, first + static_cast<std::ptrdiff_t>(Band::volume));
      }
    }
    column.swap(taken);
  }
  Vec<D, T> offset_at(std::size_t at) const {
    Vec<D, T> result;
    for (int d = 0; d < D; ++d) result[d] = offset_[d][at];
    return result;
  }
  void set_offset(std::size_t at, const Vec<D, T>& offset) {
    for (int d = 0; d < D; ++d) offset_[d][at] = offset[d];
  }
  /// A near node and the jet at its closest point, null if K did not find it.
  struct Source {
    std::size_t node;
    const Jet<T, D>* jet;
  };
  using Nearest = detail::NearestPoints<T, D, Source>;
  using Disagreement = detail::KernelDisagreement<K, Finer, T, D>;

  /// Nodes with a neighbour on the other side.
  template <Execution E>
  void search_near(const Band& band, const E& execution) {
    for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
      near_jets_[b].clear();
      Patch<T, D>& patch = patches_[worker];
      patch.read_block(band, b, 1);
      if (!detail::has_both_signs(patch)) return;
      patch.read_block(band, b, static_cast<std::ptrdiff_t>(near_reach) + stencil);
      for (std::size_t i = 0; i < Band::volume; ++i) search_near(band, patch, b, i);
    });
  }
  void search_near(const Band& band, const Patch<T, D>& patch, std::size_t b, std::size_t i) {
    const std::ptrdiff_t at = patch.entry(i);
    Vec<D, T> offset;
    if (!detail::crossing(patch, at, offset) || !band.lattice().contains(band.values().node(b, i))) return;
    const Vec<D, T> x = patch.position(at);
    Vec<D, T> y = x + offset;
    const std::size_t to = b * Band::volume + i;
    Jet<T, D> jet;
    method_[to] = search<K, M4Prime, Hat>(patch, x, y, static_cast<T>(near_reach), T(0.5), nullptr, &jet);
    error_[to] = method_[to] == not_searched ? T(0.5) : Disagreement::uncertainty(patch, y, jet);
    set_offset(to, y - x);
    slope_[to] = norm(jet.gradient) / static_cast<T>(band.spacing());
    near_jets_[b].push_back(jet);
  }
  /// Tries kernels in turn: y becomes the point if one succeeds and is not further from x than y was by more than
  /// `slack`. \param known  jet of the first kernel at y, or null. \param jet  jet at the point, if wanted
  /// \return number of the first that succeeds, or `not_searched`
  template <class First, class... Rest>
  static std::uint8_t search(const Patch<T, D>& patch, const Vec<D, T>& x, Vec<D, T>& y, T reach, T slack,
                             const Jet<T, D>* known, Jet<T, D>* jet) {
    detail::ClosestPointSearch<First, T, D> newton(patch, reach);
    Vec<D, T> at = y;
    if (newton(x, at, known) && norm(at - x) < norm(y - x) + slack) {
      y = at;
      if (jet) *jet = newton.jet();
      return static_cast<std::uint8_t>(not_searched - 1 - sizeof...(Rest));
    }
    if constexpr (sizeof...(Rest) > 0) {
      return search<Rest...>(patch, x, y, reach, slack, nullptr, jet);
    } else {
      return not_searched;
    }
  }
  /// Numbers of the nodes that search_near() found points for, block by block.
  void list_near(const Band& band) {
    near_.clear();
    near_begin_.assign(1, 0);
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      for (std::size_t i = 0; i < Band::volume; ++i) {
        if (method_[b * Band::volume + i] != unknown) near_.push_back(b * Band::volume + i);
      }
      near_begin_.push_back(near_.size());
    }
  }
  void offer_near(const Band& band, std::size_t b, Nearest& nearest) const {
    const auto reach = static_cast<std::ptrdiff_t>(std::ceil(width_ + static_cast<T>(near_reach)));
    detail::for_each_block_around(band, b, reach, [&](std::size_t from, const Index<D>& shift) {
      for (std::size_t k = near_begin_[from]; k < near_begin_[from + 1]; ++k) {
        const std::size_t node = near_[k];
        const std::size_t i = node % Band::volume;
        Vec<D, T> point = offset_at(node) + detail::position_in_block<T, D>(i);
        for (int d = 0; d < D; ++d) point[d] += static_cast<T>(shift[d]);
        nearest.offer(point, {node, method_[node] == 0 ? &near_jets_[from][k - near_begin_[from]] : nullptr});
      }
    });
  }
  /// The other nodes search from the nearest of those points.
  template <Execution E>
  void search_far(const Band& band, const E& execution) {
    for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
      Nearest& nearest = nearest_[worker];
      nearest.reset(width_ + T(0.3));  // the point that a node starts from is a little further than its own
      offer_near(band, b, nearest);
      if (nearest.empty()) return;
      nearest.settle();
      const auto is_far = [&](std::size_t i) {
        return method_[b * Band::volume + i] == unknown && nearest.found(i) &&
               band.lattice().contains(band.values().node(b, i));
      };
      detail::PointBox<K, T, D> box;
      for (std::size_t i = 0; i < Band::volume; ++i) {
        if (is_far(i)) box.add(nearest.point(i));
      }
      if (box.empty()) return;
      box.read(band, band.values().block_origin(b), wander, patches_[worker]);
      for (std::size_t i = 0; i < Band::volume; ++i) {
        if (is_far(i)) search_far(band, patches_[worker], box.corner(), nearest, b, i);
      }
    });
  }
  void search_far(const Band& band, const Patch<T, D>& patch, const Vec<D, T>& corner, const Nearest& nearest,
                  std::size_t b, std::size_t i) {
    const std::size_t to = b * Band::volume + i;
    const Source& source = nearest.source(i);
    const Vec<D, T> x = detail::position_in_block<T, D>(i) - corner;
    Vec<D, T> y = nearest.point(i) - corner;
    Jet<T, D> jet;
    method_[to] = search<K, M4Prime, Hat>(patch, x, y, width_ + T(1), T(0.01), source.jet, &jet);
    error_[to] = error_[source.node];
    const bool searched = method_[to] != not_searched;
    slope_[to] = searched ? norm(jet.gradient) / static_cast<T>(band.spacing()) : slope_[source.node];
    set_offset(to, y - x);
  }
  void count() {
    counts_ = {};
    for (const std::uint8_t method : method_) {
      if (method == unknown) continue;
      ++counts_.nodes;
      if (method == not_searched) {
        ++counts_.not_searched;
      } else if (method > 0) {
        ++counts_.lower_order;
      }
    }
  }

  T width_{};
  std::array<AlignedVector<T>, D> offset_;
  AlignedVector<T> error_;
  AlignedVector<T> slope_;
  std::vector<std::uint8_t> method_;
  AlignedVector<T> spare_;
  std::vector<std::uint8_t> spare_method_;
  std::vector<std::size_t> near_;
  std::vector<std::size_t> near_begin_;
  std::vector<std::vector<Jet<T, D>>> near_jets_;  ///< of the nodes in near_, block by block
  std::vector<Nearest> nearest_;
  std::vector<Patch<T, D>> patches_;
  ClosestPointCounts counts_;
};

}  // namespace cambium
