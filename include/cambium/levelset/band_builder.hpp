// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <cambium/levelset/block_reach.hpp>
#include <cambium/levelset/narrow_band.hpp>

namespace cambium::detail {

/// Marks which blocks of a lattice a band is to hold, without a mark twice.
template <int D>
class BlockMarks {
 public:
  using Shape = BlockShape<D>;

  explicit BlockMarks(const Lattice<D>& lattice) : lattice_(lattice), grid_(Shape::count(lattice)) {
    marked_.resize(static_cast<std::size_t>(product(grid_)));
  }
  const Lattice<D>& lattice() const { return lattice_; }
  void clear() { std::fill(marked_.begin(), marked_.end(), std::uint8_t{0}); }

  /// Marks the blocks of all nodes low, ..., high; those beyond a bounded face are left out, periodic axes wrap.
  void mark(const Index<D>& low, const Index<D>& high) {
    Index<D> first, count;
    for (int d = 0; d < D; ++d) {
      first[d] = floor_block(low[d], d);
      count[d] = floor_block(high[d], d) - first[d] + 1;
      if (lattice_.periodic(d)) count[d] = std::min(count[d], grid_[d]);
    }
    for (std::ptrdiff_t k = 0; k < product(count); ++k) {
      std::ptrdiff_t rest = k;
      std::ptrdiff_t number = 0;
      std::ptrdiff_t pitch = 1;
      for (int d = 0; d < D; ++d) {
        std::ptrdiff_t block = first[d] + rest % count[d];
        rest /= count[d];
        block = ((block % grid_[d]) + grid_[d]) % grid_[d];
        number += block * pitch;
        pitch *= grid_[d];
      }
      marked_[static_cast<std::size_t>(number)] = 1;
    }
  }
  /// Marks those blocks of a set around `block` that there are.
  void mark(const Index<D>& block, const BlockReach<D>& reach, const typename BlockReach<D>::Set& set) {
    reach.for_each(set, [&](const Index<D>& step) {
      std::ptrdiff_t number = 0;
      std::ptrdiff_t pitch = 1;
      for (int d = 0; d < D; ++d) {
        std::ptrdiff_t to = block[d] + step[d];
        if (lattice_.periodic(d)) to = ((to % grid_[d]) + grid_[d]) % grid_[d];
        if (to < 0 || to >= grid_[d]) return;
        number += to * pitch;
        pitch *= grid_[d];
      }
      marked_[static_cast<std::size_t>(number)] = 1;
    });
  }
  /// A set for the caller's use, emptied; its memory serves again.
  typename BlockReach<D>::Set& scratch(const BlockReach<D>& reach) {
    scratch_.assign(reach.words(), 0);
    return scratch_;
  }
  std::size_t count() const { return static_cast<std::size_t>(std::ranges::count(marked_, std::uint8_t{1})); }
  /// Calls f(index of the block) for every marked block in ascending order.
  template <class F>
  void for_each(F&& f) const {
    for (std::size_t k = 0; k < marked_.size(); ++k) {
      if (!marked_[k]) continue;
      Index<D> block;
      auto rest = static_cast<std::ptrdiff_t>(k);
      for (int d = 0; d < D; ++d) {
        block[d] = rest % grid_[d];
        rest /= grid_[d];
      }
      f(block);
    }
  }

 private:
  /// Block of a node, which may lie beyond the lattice: counted on periodically, or the block at the face.
  std::ptrdiff_t floor_block(std::ptrdiff_t node, int d) const {
    const std::ptrdiff_t n = lattice_.nodes()[d];
    if (!lattice_.periodic(d)) return std::clamp<std::ptrdiff_t>(node, 0, n - 1) / Shape::extent;
    const std::ptrdiff_t periods = node >= 0 ? node / n : (node + 1) / n - 1;
    return periods * grid_[d] + (node - periods * n) / Shape::extent;
  }

  Lattice<D> lattice_;
  Index<D> grid_;
  std::vector<std::uint8_t> marked_;
  typename BlockReach<D>::Set scratch_;
};

/// Keeps, of the blocks of a band, those within `reach` of its band nodes, and adds those that are missing.
/// \param came_from  of each block, the number that it had before, or -1
template <class T, int D>
void trim(NarrowBand<T, D>& band, NarrowBand<T, D>& scratch, BlockMarks<D>& marks, const BlockReach<D>& reach,
          std::vector<std::ptrdiff_t>& came_from) {
  marks.clear();
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    auto& set = marks.scratch(reach);
    const auto phi = band.values().block(b);
    for (std::size_t i = 0; i < phi.size(); ++i) {
      if (band.in_band(phi[i]) && band.lattice().contains(band.values().node(b, i))) reach.add(i, set);
    }
    marks.mark(band.values().block_index(b), reach, set);
  }
  scratch.values().clear();
  scratch.values().reserve(marks.count());
  came_from.clear();
  marks.for_each([&](const Index<D>& block) {
    const std::ptrdiff_t from = band.values().find(block);
    came_from.push_back(from);
    const T far = band.far_value(block);
    const auto to = scratch.values().block(scratch.values().activate(block));
    if (from < 0) {
      std::fill(to.begin(), to.end(), far);
    } else {
      std::ranges::copy(band.values().block(static_cast<std::size_t>(from)), to.begin());
    }
  });
  scratch.find_far_sides();
  std::swap(band, scratch);
}

/// Gives the nodes of stored blocks whose value is unknown (NaN) the far value of the side of the known nodes next to
/// them. Nodes beyond the lattice become far, too.
/// \throws InterfaceError if a block has no known node
template <class T, int D>
void fill_unknown(NarrowBand<T, D>& band, std::size_t b) {
  const auto phi = band.values().block(b);
  bool any = false;
  for (std::size_t i = 0; i < phi.size(); ++i) any |= !std::isnan(phi[i]);
  if (!any) throw InterfaceError(message("block ", band.values().block_index(b), " of the band has no known value"));
  for (bool left = true; left;) {
    left = false;
    std::size_t pitch = 1;
    for (int d = 0; d < D; ++d, pitch *= BlockShape<D>::extent) {
      const auto carry = [&](std::size_t i, std::size_t from) {
        if (std::isnan(phi[i]) && !std::isnan(phi[from])) {
          phi[i] = phi[from] < T(0) ? -band.half_width() : band.half_width();
        }
      };
      for (std::size_t i = 0; i < phi.size(); ++i) {
        if (i / pitch % BlockShape<D>::extent > 0) carry(i, i - pitch);
      }
      for (std::size_t i = phi.size(); i-- > 0;) {
        if (i / pitch % BlockShape<D>::extent + 1 < BlockShape<D>::extent) carry(i, i + pitch);
      }
    }
    for (const T value : phi) left |= std::isnan(value);
  }
}

}  // namespace cambium::detail
