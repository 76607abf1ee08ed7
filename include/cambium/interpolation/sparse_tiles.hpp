// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <cambium/core/sparse.hpp>
#include <cambium/interpolation/closure.hpp>
#include <cambium/interpolation/row_order.hpp>
#include <cambium/parallel/execution.hpp>

namespace cambium::detail {

/// The blocks of cells of a lattice that hold particles, in the order of their numbers.
template <class K, class P, int D>
class SparseTiles {
 public:
  using Shape = BlockShape<D>;
  static constexpr std::ptrdiff_t extent = Shape::extent;
  static constexpr std::size_t rows_per_block = Shape::volume / extent;

  explicit SparseTiles(const Lattice<D>& lattice) : lattice_(lattice), grid_(Shape::count(lattice)) {
    for (int d = 0; d < D; ++d) axis_[d] = AxisLocator<K, P>(lattice, d);
    slot_.assign(static_cast<std::size_t>(product(grid_)), -1);
  }

  const Lattice<D>& lattice() const { return lattice_; }
  const AxisLocator<K, P>& axis(int d) const { return axis_[d]; }
  std::size_t size() const { return tiles_.size(); }
  /// Index of the block of tile k.
  const Index<D>& operator[](std::size_t k) const { return tiles_[k]; }

  /// Finds the blocks of cells that hold particles and orders the particles by their rows.
  /// \throws PositionError for the first particle that is not finite or outside a bounded box
  template <Execution E>
  void order(Columns<D, const P> x, RowOrder& order, const E& execution) {
    require_positions(lattice_.domain(), x, execution);
    for (const auto& tile : tiles_) slot_[entry(tile)] = -1;
    tiles_.clear();
    block_of_.resize(x.size());
    row_in_block_.resize(x.size());
    for_each(execution, x.size(), [&](std::size_t p) { locate(x, p); });
    for (const std::uint32_t block : block_of_) {
      if (slot_[block] >= 0) continue;
      slot_[block] = 0;
      tiles_.push_back(block_at(block));
    }
    std::sort(tiles_.begin(), tiles_.end(), [&](const auto& a, const auto& b) { return entry(a) < entry(b); });
    for (std::size_t k = 0; k < tiles_.size(); ++k) slot_[entry(tiles_[k])] = static_cast<std::int32_t>(k);
    order.build(
        x.size(), tiles_.size() * rows_per_block,
        [&](std::size_t p) {
          return static_cast<std::size_t>(slot_[block_of_[p]]) * rows_per_block + row_in_block_[p];
        },
        execution);
  }

  /// Cells of a tile; on the upper side the lattice may end before the block does.
  CellBox<D> cells_of(std::size_t k) const {
    CellBox<D> box;
    for (int d = 0; d < D; ++d) {
      box.first[d] = tiles_[k][d] * extent;
      box.count[d] = std::min<std::ptrdiff_t>(extent, cells_along<K>(lattice_, d) - box.first[d]);
    }
    return box;
  }
  /// Where the particles of a row of cells of tile k are in the order.
  auto rows_of(std::size_t k, const RowOrder& order) const {
    return [k, &order](const Index<D>& cell) {
      std::size_t row = 0;
      for (int d = D - 1; d > 0; --d) row = row * extent + static_cast<std::size_t>(cell[d] % extent);
      return order.row(k * rows_per_block + row);
    };
  }

 private:
  std::size_t entry(const Index<D>& block) const {
    std::ptrdiff_t n = block[D - 1];
    for (int d = D - 2; d >= 0; --d) n = n * grid_[d] + block[d];
    return static_cast<std::size_t>(n);
  }
  Index<D> block_at(std::size_t number) const {
    Index<D> block;
    auto rest = static_cast<std::ptrdiff_t>(number);
    for (int d = 0; d < D; ++d) {
      block[d] = rest % grid_[d];
      rest /= grid_[d];
    }
    return block;
  }
  void locate(Columns<D, const P> x, std::size_t p) {
    Index<D> block;
    std::ptrdiff_t row = 0;
    for (int d = D - 1; d >= 0; --d) {
      const std::ptrdiff_t cell = axis_[d](x.column(d)[p]).cell;
      block[d] = cell / extent;
      if (d > 0) row = row * extent + cell % extent;
    }
    block_of_[p] = static_cast<std::uint32_t>(entry(block));
    row_in_block_[p] = static_cast<std::uint32_t>(row);
  }

  Lattice<D> lattice_;
  Index<D> grid_;
  std::array<AxisLocator<K, P>, D> axis_;
  std::vector<std::int32_t> slot_;
  std::vector<Index<D>> tiles_;
  std::vector<std::uint32_t> block_of_;
  std::vector<std::uint32_t> row_in_block_;
};

}  // namespace cambium::detail
