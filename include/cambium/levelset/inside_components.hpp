// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <utility>
#include <vector>

#include <cambium/levelset/disjoint_sets.hpp>
#include <cambium/levelset/narrow_band.hpp>

namespace cambium::detail {

/// Counts the connected components of the inside: nodes inside are connected along edges of the lattice, and across
/// faces of cells where the interface leaves them connected. A block that is not stored is one item.
template <class T, int D>
class InsideComponents {
 public:
  using Band = NarrowBand<T, D>;

  explicit InsideComponents(const Band& band)
      : band_(band),
        stored_(band.blocks() * Band::volume),
        sets_(stored_ + static_cast<std::size_t>(product(band.values().block_grid()))) {}

  /// \param joins  pairs of nodes inside that are connected across a face of a cell
  template <Execution E>
  std::size_t count(const std::vector<std::pair<Index<D>, Index<D>>>& joins, const E& execution) {
    for_each_piece(execution, band_.blocks(), 1, [&](std::size_t b, std::size_t) { join_within(b); });
    for (std::size_t b = 0; b < band_.blocks(); ++b) join_ahead(b);
    const Index<D>& grid = band_.values().block_grid();
    for (std::size_t k = stored_; k < stored_ + static_cast<std::size_t>(product(grid)); ++k) join_far(k);
    for (const auto& [a, b] : joins) sets_.join(item(a), item(b));
    return count_sets();
  }

 private:
  std::size_t far_item(const Index<D>& block) const {
    std::ptrdiff_t n = block[D - 1];
    for (int d = D - 2; d >= 0; --d) n = n * band_.values().block_grid()[d] + block[d];
    return stored_ + static_cast<std::size_t>(n);
  }
  Index<D> far_block(std::size_t k) const {
    Index<D> block;
    auto rest = static_cast<std::ptrdiff_t>(k - stored_);
    for (int d = 0; d < D; ++d) {
      block[d] = rest % band_.values().block_grid()[d];
      rest /= band_.values().block_grid()[d];
    }
    return block;
  }
  /// The item of a node of the lattice.
  std::size_t item(const Index<D>& node) const {
    const Index<D> block = band_.values().block_of(node);
    const std::ptrdiff_t b = band_.values().find(block);
    return b < 0 ? far_item(block) : static_cast<std::size_t>(b) * Band::volume + band_.values().offset(node);
  }
  bool inside(std::size_t b, std::size_t i) const {
    return band_.values().block(b)[i] < T(0) && band_.lattice().contains(band_.values().node(b, i));
  }

  void join_within(std::size_t b) {
    for (std::size_t i = 0; i < Band::volume; ++i) {
      if (!inside(b, i)) continue;
      std::size_t pitch = 1;
      for (int d = 0; d < D; ++d, pitch *= Band::extent) {
        if (i / pitch % Band::extent == 0 || !(band_.values().block(b)[i - pitch] < T(0))) continue;
        sets_.join(b * Band::volume + i, b * Band::volume + i - pitch);
      }
    }
  }
  /// Joins the nodes of a block with those of the blocks ahead, and of blocks behind that are not stored.
  void join_ahead(std::size_t b) {
    for (std::size_t i = 0; i < Band::volume; ++i) {
      const Index<D> node = band_.values().node(b, i);
      for (int d = 0; d < D; ++d) {
        const std::ptrdiff_t last = band_.lattice().nodes()[d] - 1;
        const bool first_of_block = node[d] % Band::extent == 0;
        const bool last_of_block = (node[d] + 1) % Band::extent == 0 || node[d] == last;
        if ((!first_of_block && !last_of_block) || !inside(b, i)) continue;
        if (last_of_block) join_step(b, i, node, d, 1, true);
        if (first_of_block) join_step(b, i, node, d, -1, false);
      }
    }
  }
  void join_step(std::size_t b, std::size_t i, Index<D> node, int axis, int way, bool to_stored) {
    node[axis] += way;
    const std::ptrdiff_t n = band_.lattice().nodes()[axis];
    if (node[axis] < 0 || node[axis] >= n) {
      if (!band_.lattice().periodic(axis)) return;
      node = band_.inside(node);
    }
    const std::ptrdiff_t to = band_.values().find(band_.values().block_of(node));
    if (to >= 0 ? to_stored && band_(node) < T(0) : band_(node) < T(0)) sets_.join(b * Band::volume + i, item(node));
  }
  bool is_far_inside(const Index<D>& block) const {
    return band_.values().find(block) < 0 && band_.far_value(block) < T(0);
  }
  void join_far(std::size_t k) {
    const Index<D> block = far_block(k);
    if (!is_far_inside(block)) return;
    band_.for_each_neighbour(block, [&](const Index<D>& next, int, int) {
      if (is_far_inside(next)) sets_.join(k, far_item(next));
    });
  }
  std::size_t count_sets() const {
    std::size_t result = 0;
    for (std::size_t b = 0; b < band_.blocks(); ++b) {
      for (std::size_t i = 0; i < Band::volume; ++i) {
        result += sets_.stands_for_set(b * Band::volume + i) && inside(b, i) ? 1 : 0;
      }
    }
    const auto grid = static_cast<std::size_t>(product(band_.values().block_grid()));
    for (std::size_t k = stored_; k < stored_ + grid; ++k) {
      result += sets_.stands_for_set(k) && is_far_inside(far_block(k)) ? 1 : 0;
    }
    return result;
  }

  const Band& band_;
  std::size_t stored_;
  DisjointSets sets_;
};

}  // namespace cambium::detail
