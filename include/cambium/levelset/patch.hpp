// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <cambium/core/aligned.hpp>
#include <cambium/levelset/narrow_band.hpp>

namespace cambium {

/// Copy of a box of nodes of a band: a small dense array that stencils run over without asking where a node is kept.
/// Beyond a bounded face it holds the value of the nearest node on the face; periodic axes wrap.
template <class T, int D>
class Patch {
 public:
  using Band = NarrowBand<T, D>;

  /// Nodes along each axis.
  const Index<D>& edge() const { return edge_; }
  const Index<D>& stride() const { return stride_; }
  /// Node of the lattice at entry 0; it may lie beyond the lattice.
  const Index<D>& first() const { return first_; }
  const T* data() const { return values_.data(); }
  T operator[](std::ptrdiff_t at) const { return values_[static_cast<std::size_t>(at)]; }
  /// Position of an entry in spacings from entry 0.
  Vec<D, T> position(std::ptrdiff_t at) const {
    Vec<D, T> x;
    for (int d = 0; d < D; ++d) x[d] = static_cast<T>(at / stride_[d] % edge_[d]);
    return x;
  }

  /// Copies block `b` with `halo` nodes around it.
  void read_block(const Band& band, std::size_t b, std::ptrdiff_t halo) {
    Index<D> first = band.values().block_origin(b);
    halo_ = halo;
    for (int d = 0; d < D; ++d) first[d] -= halo;
    read(band, first, Index<D>::constant(extent + 2 * halo));
  }
  /// Entry of node `i` of the block read last (its number in the block, axis 0 fastest).
  std::ptrdiff_t entry(std::size_t i) const {
    std::ptrdiff_t at = 0;
    for (int d = 0; d < D; ++d) {
      at += (halo_ + static_cast<std::ptrdiff_t>(i) % extent) * stride_[d];
      i /= Band::extent;
    }
    return at;
  }

  /// Copies the nodes first, ..., first + edge - 1.
  void read(const Band& band, const Index<D>& first, const Index<D>& edge) {
    first_ = first;
    edge_ = edge;
    stride_[0] = 1;
    for (int d = 1; d < D; ++d) stride_[d] = stride_[d - 1] * edge_[d - 1];
    // A vector that starts at the last stencil of a row may reach beyond the last node.
    const auto size = static_cast<std::size_t>(stride_[D - 1] * edge_[D - 1] + 16);
    if (values_.size() < size) values_.resize(size);
    if (inside(band)) {
      read_blocks(band);
    } else {
      read_rows(band);
    }
  }

 private:
  static constexpr std::ptrdiff_t extent = Band::extent;

  bool inside(const Band& band) const {
    for (int d = 0; d < D; ++d) {
      if (first_[d] < 0 || first_[d] + edge_[d] > band.lattice().nodes()[d]) return false;
    }
    return true;
  }
  void read_blocks(const Band& band) {
    Index<D> low, count;
    for (int d = 0; d < D; ++d) {
      low[d] = first_[d] / extent;
      count[d] = (first_[d] + edge_[d] - 1) / extent - low[d] + 1;
    }
    for (std::ptrdiff_t k = 0; k < product(count); ++k) {
      Index<D> block;
      std::ptrdiff_t rest = k;
      for (int d = 0; d < D; ++d) {
        block[d] = low[d] + rest % count[d];
        rest /= count[d];
      }
      copy_block(band, block);
    }
  }
  /// The part of one block that lies in the patch, row by row.
  void copy_block(const Band& band, const Index<D>& block) {
    Index<D> from, size;
    std::ptrdiff_t to = 0;
    for (int d = 0; d < D; ++d) {
      const std::ptrdiff_t start = std::max(first_[d], block[d] * extent);
      const std::ptrdiff_t end = std::min(first_[d] + edge_[d], (block[d] + 1) * extent);
      from[d] = start - block[d] * extent;
      size[d] = end - start;
      to += (start - first_[d]) * stride_[d];
    }
    const std::ptrdiff_t b = band.values().find(block);
    const T* source = b < 0 ? nullptr : band.values().block(static_cast<std::size_t>(b)).data();
    const T far = band.far_value(block);
    for (std::ptrdiff_t row = 0; row < product(size) / size[0]; ++row) {
      std::ptrdiff_t rest = row;
      std::ptrdiff_t at = from[0];
      std::ptrdiff_t out = to;
      std::ptrdiff_t pitch = extent;
      for (int d = 1; d < D; ++d) {
        at += (from[d] + rest % size[d]) * pitch;
        out += rest % size[d] * stride_[d];
        rest /= size[d];
        pitch *= extent;
      }
      if (source) {
        std::copy_n(source + at, size[0], values_.data() + out);
      } else {
        std::fill_n(values_.data() + out, size[0], far);
      }
    }
  }
  /// Any patch, row by row: nodes beyond the lattice are brought inside.
  void read_rows(const Band& band) {
    const std::ptrdiff_t rows = product(edge_) / edge_[0];
    for (std::ptrdiff_t row = 0; row < rows; ++row) {
      Index<D> node = first_;
      std::ptrdiff_t rest = row;
      for (int d = 1; d < D; ++d) {
        node[d] += rest % edge_[d];
        rest /= edge_[d];
      }
      T* out = values_.data() + row * edge_[0];
      for (std::ptrdiff_t i = 0; i < edge_[0];) {
        node[0] = first_[0] + i;
        i += copy_piece(band, node, edge_[0] - i, out + i);
      }
    }
  }
  /// The nodes from `node` on along axis 0 that lie in one block, or one node beyond the lattice. \return how many
  static std::ptrdiff_t copy_piece(const Band& band, const Index<D>& node, std::ptrdiff_t most, T* out) {
    const Index<D> from = band.inside(node);
    const bool beyond = from[0] != node[0] && !band.lattice().periodic(0);
    const std::ptrdiff_t ahead =
        beyond ? 1 : std::min({most, extent - from[0] % extent, band.lattice().nodes()[0] - from[0]});
    const Index<D> block = band.values().block_of(from);
    const std::ptrdiff_t b = band.values().find(block);
    if (b < 0) {
      std::fill_n(out, ahead, band.far_value(block));
    } else {
      std::copy_n(band.values().block(static_cast<std::size_t>(b)).data() + band.values().offset(from), ahead, out);
    }
    return ahead;
  }

  std::ptrdiff_t halo_ = 0;
  Index<D> edge_{};
  Index<D> stride_{};
  Index<D> first_{};
  AlignedVector<T> values_;
};

}  // namespace cambium
