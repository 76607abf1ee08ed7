// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <cambium/core/sparse.hpp>

namespace cambium::detail {

/// Which blocks around its own are within a distance of a node: a table with a bit for each of them, for each node of a
/// block.
template <int D>
class BlockReach {
 public:
  using Shape = BlockShape<D>;
  /// A set of blocks around one.
  using Set = std::vector<std::uint64_t>;

  /// \param reach  distance in spacings
  BlockReach(const Lattice<D>& lattice, double reach) {
    Index<D> overhang{};  // what the last block of a periodic axis has beyond the lattice brings its neighbours nearer
    std::ptrdiff_t furthest = 0;
    for (int d = 0; d < D; ++d) {
      if (lattice.periodic(d)) overhang[d] = Shape::count(lattice)[d] * Shape::extent - lattice.nodes()[d];
      furthest = std::max(furthest, overhang[d]);
    }
    const double nodes = std::ceil(reach) + static_cast<double>(furthest);
    const std::ptrdiff_t side = 2 * static_cast<std::ptrdiff_t>(std::ceil(nodes / Shape::extent)) + 1;
    for (std::ptrdiff_t k = 0; k < product(Index<D>::constant(side)); ++k) {
      Index<D> block;
      std::ptrdiff_t rest = k;
      for (int d = 0; d < D; ++d, rest /= side) block[d] = rest % side - side / 2;
      around_.push_back(block);
    }
    words_ = (around_.size() + 63) / 64;
    near_.resize(words_ * Shape::volume);
    for (std::size_t i = 0; i < Shape::volume; ++i) {
      for (std::size_t k = 0; k < around_.size(); ++k) {
        if (square_of_distance(i, around_[k], overhang) > reach * reach) continue;
        near_[i * words_ + k / 64] |= std::uint64_t{1} << (k % 64);
      }
    }
  }

  /// Length of a set.
  std::size_t words() const { return words_; }
  Set empty_set() const { return Set(words_, 0); }
  /// Adds the blocks near node i of a block.
  void add(std::size_t i, Set& set) const {
    for (std::size_t w = 0; w < words_; ++w) set[w] |= near_[i * words_ + w];
  }
  /// Calls f(block minus own block) for the blocks of a set.
  template <class F>
  void for_each(const Set& set, F&& f) const {
    for (std::size_t k = 0; k < around_.size(); ++k) {
      if (set[k / 64] >> (k % 64) & 1U) f(around_[k]);
    }
  }

 private:
  static double square_of_distance(std::size_t i, const Index<D>& block, const Index<D>& overhang) {
    double square = 0.0;
    for (int d = 0; d < D; ++d, i /= Shape::extent) {
      const auto local = static_cast<std::ptrdiff_t>(i % Shape::extent);
      const std::ptrdiff_t first = block[d] * Shape::extent, last = first + Shape::extent - 1;
      const std::ptrdiff_t away = block[d] < 0 ? local - last : block[d] > 0 ? first - local : 0;
      const auto distance = static_cast<double>(std::max<std::ptrdiff_t>(away - overhang[d], 0));
      square += distance * distance;
    }
    return square;
  }

  std::vector<Index<D>> around_;
  std::size_t words_ = 0;
  std::vector<std::uint64_t> near_;
};

}  // namespace cambium::detail
