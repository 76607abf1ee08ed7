// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <type_traits>

#include <cambium/core/field.hpp>

namespace cambium {

/// Geometry of the blocks a lattice is cut into: 64 nodes in 1D, 16^2 in 2D, 8^3 in 3D.
template <int D>
struct BlockShape {
  static constexpr int extent = D == 1 ? 64 : D == 2 ? 16 : 8;
  static constexpr std::size_t volume = D == 1 ? 64 : D == 2 ? 256 : 512;

  /// Number of blocks along each axis that cover the lattice.
  static Index<D> count(const Lattice<D>& lattice) {
    Index<D> result;
    for (int d = 0; d < D; ++d) result[d] = (lattice.nodes()[d] + extent - 1) / extent;
    return result;
  }
};

/// Sparse field: blocks of nodes only where they were activated; every other node reads as the background value.
///
/// Blocks are found through a table with one 4-byte entry per possible block (1/128 byte per node in 3D). Blocks keep
/// the order of their activation, so that iteration over blocks is deterministic.
template <class T, int D>
class Field<T, D, Sparse> {
 public:
  using value_type = T;
  using storage = Sparse;
  using Shape = BlockShape<D>;
  static constexpr int dimension = D;

  explicit Field(const Lattice<D>& lattice, T background = T{})
      : lattice_(lattice),
        background_(background),
        grid_(Shape::count(lattice)),
        table_(static_cast<std::size_t>(product(grid_)), absent) {}

  const Lattice<D>& lattice() const { return lattice_; }
  const T& background() const { return background_; }

  /// Number of blocks along each axis that would cover the lattice.
  const Index<D>& block_grid() const { return grid_; }
  /// Number of active blocks.
  std::size_t blocks() const { return origins_.size(); }
  /// Coordinates of active block `b` in the grid of blocks.
  const Index<D>& block_index(std::size_t b) const { return origins_[b]; }
  /// First node of active block `b`.
  Index<D> block_origin(std::size_t b) const { return origins_[b] * Shape::extent; }
  /// The values of active block `b`, axis 0 fastest; nodes beyond the lattice are padding.
  std::span<T> block(std::size_t b) { return {values_.data() + b * Shape::volume, Shape::volume}; }
  std::span<const T> block(std::size_t b) const { return {values_.data() + b * Shape::volume, Shape::volume}; }

  /// Number of the active block at `index` in the grid of blocks, or -1.
  std::ptrdiff_t find(const Index<D>& index) const { return table_[entry(index)]; }
  /// Activates the block at `index` (filled with the background if it is new) and returns its number. Spans taken of
  /// blocks before are no longer valid. \throws LatticeError if there is no such block
  std::size_t activate(const Index<D>& index) {
    for (int d = 0; d < D; ++d) {
      if (index[d] >= 0 && index[d] < grid_[d]) continue;
      throw LatticeError(detail::message("block ", index, " is outside the grid of ", grid_, " blocks along axis ", d,
                                         ": wrap or skip what lies beyond the lattice"));
    }
    std::int32_t& slot = table_[entry(index)];
    if (slot == absent) {
      values_.resize(values_.size() + Shape::volume, background_);
      origins_.push_back(index);
      slot = static_cast<std::int32_t>(origins_.size() - 1);
    }
    return static_cast<std::size_t>(slot);
  }
  /// Activates the block that holds `node`, as activate(). \throws LatticeError if the node is not of the lattice
  std::size_t activate_node(const Index<D>& node) {
    if (!lattice_.contains(node)) {
      throw LatticeError(detail::message("node ", node, " is outside the lattice of ", lattice_.nodes(),
                                         " nodes: wrap or skip what lies beyond it"));
    }
    return activate(block_of(node));
  }
  /// Makes room for so many blocks, so that memory is neither moved nor set aside in vain when they are activated.
  void reserve(std::size_t blocks) {
    values_.reserve(blocks * Shape::volume);
    origins_.reserve(blocks);
  }
  /// Removes all blocks; keeps the memory for reuse.
  void clear() {
    for (const auto& index : origins_) table_[entry(index)] = absent;
    origins_.clear();
    values_.clear();
  }

  /// Value at a node of the lattice; the background where no block is active.
  const T& operator()(const Index<D>& node) const {
    const std::ptrdiff_t b = find(block_of(node));
    return b < 0 ? background_ : values_[static_cast<std::size_t>(b) * Shape::volume + offset(node)];
  }
  /// Sets the value at a node, activating its block if need be. \throws LatticeError if the node is not of the lattice
  void set(const Index<D>& node, const T& value) {
    values_[activate_node(node) * Shape::volume + offset(node)] = value;
  }

  void fill(const T& value) { std::fill(values_.begin(), values_.end(), value); }

  /// Coordinates of the block that holds `node`.
  static Index<D> block_of(const Index<D>& node) {
    Index<D> index;
    for (int d = 0; d < D; ++d) index[d] = node[d] / Shape::extent;
    return index;
  }
  /// Position of `node` inside its block, axis 0 fastest.
  static std::size_t offset(const Index<D>& node) {
    std::ptrdiff_t result = 0;
    for (int d = D - 1; d >= 0; --d) result = result * Shape::extent + node[d] % Shape::extent;
    return static_cast<std::size_t>(result);
  }
  /// Node of entry `i` of active block `b`.
  Index<D> node(std::size_t b, std::size_t i) const {
    Index<D> result = block_origin(b);
    for (int d = 0; d < D; ++d) {
      result[d] += static_cast<std::ptrdiff_t>(i % Shape::extent);
      i /= Shape::extent;
    }
    return result;
  }

 private:
  static constexpr std::int32_t absent = -1;

  std::size_t entry(const Index<D>& index) const {
    std::ptrdiff_t n = index[D - 1];
    for (int d = D - 2; d >= 0; --d) n = n * grid_[d] + index[d];
    return static_cast<std::size_t>(n);
  }

  Lattice<D> lattice_;
  T background_;
  Index<D> grid_;
  std::vector<std::int32_t> table_;
  std::vector<Index<D>> origins_;
  AlignedVector<T> values_;
};

}  // namespace cambium
