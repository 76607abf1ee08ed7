// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <cambium/core/columns.hpp>
#include <cambium/levelset/jet.hpp>
#include <cambium/levelset/patch.hpp>

namespace cambium::detail {

/// Points inside a lattice sorted by the stored block of a band that holds the node below them.
template <class T, int D>
class BandReader {
 public:
  using Band = NarrowBand<T, D>;

  /// Finds the block of every point. \param x  positions; along periodic axes wrapped
  template <Execution E>
  void locate(const Band& band, Columns<D, const T> x, const E& execution) {
    block_.resize(x.size());
    for_each(execution, x.size(), [&](std::size_t p) {
      const std::ptrdiff_t b = band.values().find(band.values().block_of(cell(band.lattice(), x[p])));
      block_[p] = static_cast<std::uint32_t>(b < 0 ? static_cast<std::ptrdiff_t>(band.blocks()) : b);
    });
    begin_.assign(band.blocks() + 2, 0);
    for (const std::uint32_t b : block_) ++begin_[b + 1];
    for (std::size_t b = 0; b + 1 < begin_.size(); ++b) begin_[b + 1] += begin_[b];
    next_.assign(begin_.begin(), begin_.end() - 1);
    order_.resize(x.size());
    for (std::size_t p = 0; p < x.size(); ++p) order_[next_[block_[p]]++] = p;
  }
  /// Numbers of the points of block b in ascending order; those of b = band.blocks() are in no stored block.
  std::span<const std::size_t> points(std::size_t b) const {
    return {order_.data() + begin_[b], begin_[b + 1] - begin_[b]};
  }

  /// phi := value of the interpolant of kernel K at the points located; the far value in blocks not stored.
  template <class K, Execution E>
  void read(const Band& band, Columns<D, const T> x, std::span<T> phi, const E& execution) {
    patches_.resize(std::max(patches_.size(), static_cast<std::size_t>(execution.count())));
    for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t w, std::size_t b, std::size_t) {
      if (points(b).empty()) return;
      Patch<T, D>& patch = patches_[w];
      patch.read_block(band, b, K::support / 2 + 1);
      for (const std::size_t p : points(b)) {
        phi[p] = Interpolant<K, T, D>::value(patch.data(), patch.stride(), local(band.lattice(), patch, x[p]));
      }
    });
    for (const std::size_t p : points(band.blocks())) {
      phi[p] = band.far_value(band.values().block_of(cell(band.lattice(), x[p])));
    }
  }

  /// The lowest node of the cell that holds a point in the box.
  static Index<D> cell(const Lattice<D>& lattice, const Vec<D, T>& x) {
    Index<D> node;
    for (int d = 0; d < D; ++d) {
      const double u = (static_cast<double>(x[d]) - lattice.box().lo[d]) / lattice.spacing();
      const std::ptrdiff_t cells = lattice.nodes()[d] - (lattice.periodic(d) ? 0 : 1);
      node[d] = std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(std::floor(u)), 0, cells - 1);
    }
    return node;
  }
  /// A point in spacings from entry 0 of a patch.
  static Vec<D, T> local(const Lattice<D>& lattice, const Patch<T, D>& patch, const Vec<D, T>& x) {
    Vec<D, T> u;
    for (int d = 0; d < D; ++d) {
      const double from = (static_cast<double>(x[d]) - lattice.box().lo[d]) / lattice.spacing();
      u[d] = static_cast<T>(from - static_cast<double>(patch.first()[d]));
    }
    return u;
  }

 private:
  std::vector<std::uint32_t> block_;
  std::vector<std::size_t> begin_;
  std::vector<std::size_t> next_;
  std::vector<std::size_t> order_;
  std::vector<Patch<T, D>> patches_;
};

}  // namespace cambium::detail
