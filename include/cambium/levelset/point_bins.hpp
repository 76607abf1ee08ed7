// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <cambium/core/columns.hpp>
#include <cambium/core/sparse.hpp>

namespace cambium::detail {

/// Points sorted into bins, one for each possible block of a lattice, for the question which are near a block.
template <class T, int D>
class PointBins {
 public:
  using Shape = BlockShape<D>;

  /// \param x  positions; on periodic axes they may lie beyond the lattice, on bounded ones those are left out
  void fill(const Lattice<D>& lattice, Columns<D, const T> x) {
    grid_ = Shape::count(lattice);
    bin_.resize(x.size());
    begin_.assign(static_cast<std::size_t>(product(grid_)) + 1, 0);
    for (std::size_t p = 0; p < x.size(); ++p) {
      bin_[p] = bin(lattice, spacings(lattice, x[p]));
      if (bin_[p] != none) ++begin_[bin_[p] + 1];
    }
    for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
    next_.assign(begin_.begin(), begin_.end() - 1);
    points_.resize(begin_.back());
    for (std::size_t p = 0; p < x.size(); ++p) {
      if (bin_[p] != none) points_[next_[bin_[p]]++] = spacings(lattice, x[p]);
    }
  }

  /// Position in spacings from the first node, wrapped on periodic axes.
  static Vec<D, T> spacings(const Lattice<D>& lattice, const Vec<D, T>& x) {
    Vec<D, T> u;
    for (int d = 0; d < D; ++d) {
      u[d] = static_cast<T>((static_cast<double>(x[d]) - lattice.box().lo[d]) / lattice.spacing());
      if (!lattice.periodic(d)) continue;
      const T period = static_cast<T>(lattice.nodes()[d]);
      u[d] -= period * std::floor(u[d] / period);
      if (u[d] >= period) u[d] = T(0);
    }
    return u;
  }
  /// The points of a bin, in spacings from the first node of the lattice, in the order they were given.
  std::span<const Vec<D, T>> operator[](const Index<D>& block) const {
    const std::size_t k = number(block);
    return {points_.data() + begin_[k], begin_[k + 1] - begin_[k]};
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  std::size_t number(const Index<D>& block) const {
    std::ptrdiff_t n = block[D - 1];
    for (int d = D - 2; d >= 0; --d) n = n * grid_[d] + block[d];
    return static_cast<std::size_t>(n);
  }
  std::size_t bin(const Lattice<D>& lattice, const Vec<D, T>& u) const {
    Index<D> block;
    for (int d = 0; d < D; ++d) {
      const auto cell = static_cast<std::ptrdiff_t>(std::floor(u[d]));
      if (cell < 0 || cell >= lattice.nodes()[d]) return none;
      block[d] = cell / Shape::extent;
    }
    return number(block);
  }

  Index<D> grid_{};
  std::vector<std::size_t> bin_;
  std::vector<std::size_t> begin_;
  std::vector<std::size_t> next_;
  std::vector<Vec<D, T>> points_;
};

/// Calls f(block, shift) for every possible block with nodes within `reach` nodes of block `centre`, itself included;
/// shift is the first node of that block minus that of the centre, across periodic faces if need be.
template <int D, class F>
void for_each_block_within(const Lattice<D>& lattice, const Index<D>& centre, std::ptrdiff_t reach, F&& f) {
  constexpr std::ptrdiff_t extent = BlockShape<D>::extent;
  const Index<D> grid = BlockShape<D>::count(lattice);
  Index<D> ahead, width;
  for (int d = 0; d < D; ++d) {
    // The last block of a periodic axis may be a thin one.
    const bool thin = lattice.periodic(d) && lattice.nodes()[d] % extent != 0;
    ahead[d] = (reach + extent - 1) / extent + (thin ? 1 : 0);
    width[d] = 2 * ahead[d] + 1;
  }
  for (std::ptrdiff_t k = 0; k < product(width); ++k) {
    Index<D> block = centre;
    Index<D> shift;
    std::ptrdiff_t rest = k;
    bool exists = true;
    for (int d = 0; d < D; ++d) {
      block[d] += rest % width[d] - ahead[d];
      rest /= width[d];
      exists &= (block[d] >= 0 && block[d] < grid[d]) || lattice.periodic(d);
      const std::ptrdiff_t periods = block[d] >= 0 ? block[d] / grid[d] : (block[d] + 1) / grid[d] - 1;
      block[d] -= periods * grid[d];
      shift[d] = (block[d] - centre[d]) * extent + periods * lattice.nodes()[d];
    }
    if (exists) f(block, shift);
  }
}

}  // namespace cambium::detail
