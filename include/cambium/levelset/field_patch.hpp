// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <cambium/levelset/narrow_band.hpp>

namespace cambium {

/// Copy of a box of nodes of a field of scalars or vectors that is kept in blocks: one small dense array for each
/// component, as Patch is for phi.
///
/// Beyond a bounded face it holds the value of the nearest node on the face; periodic axes wrap. In blocks that are not
/// stored the field is continued as a constant from the nearest stored node along a lattice line of the box.
template <class T, int D>
class FieldPatch {
 public:
  const Index<D>& stride() const { return stride_; }
  /// Array of component c.
  const T* data(int c) const { return values_[static_cast<std::size_t>(c)].data(); }

  /// Copies the nodes first, ..., first + edge - 1.
  /// \tparam V  T or Vec<C, T>. \throws InterfaceError if none of the nodes is stored
  template <class V>
  void read(const Field<V, D, Sparse>& field, const Index<D>& first, const Index<D>& edge) {
    edge_ = edge;
    stride_[0] = 1;
    for (int d = 1; d < D; ++d) stride_[d] = stride_[d - 1] * edge_[d - 1];
    const auto size = static_cast<std::size_t>(product(edge_));
    if (values_.size() < static_cast<std::size_t>(Components<V>::count)) values_.resize(Components<V>::count);
    // A vector that starts at the last stencil of a row may reach beyond the last node.
    for (auto& column : values_) {
      if (column.size() < size + 16) column.resize(size + 16);
    }
    unknown_.clear();
    for (std::size_t row = 0; row < size; row += static_cast<std::size_t>(edge_[0])) {
      read_row(field, first, static_cast<std::ptrdiff_t>(row));
    }
    if (!unknown_.empty()) continue_constant(first);
  }

 private:
  static constexpr std::ptrdiff_t extent = BlockShape<D>::extent;

  static std::ptrdiff_t inside(const Lattice<D>& lattice, int d, std::ptrdiff_t i) {
    return lattice.periodic(d) ? lattice.wrap(d, i) : std::clamp<std::ptrdiff_t>(i, 0, lattice.nodes()[d] - 1);
  }
  /// Nodes that are not stored go to unknown_.
  template <class V>
  void read_row(const Field<V, D, Sparse>& field, const Index<D>& first, std::ptrdiff_t row) {
    using Storage = Field<V, D, Sparse>;
    Index<D> node = first;
    for (int d = 1; d < D; ++d) node[d] = inside(field.lattice(), d, first[d] + row / stride_[d] % edge_[d]);
    std::ptrdiff_t block = -1;  // along axis 0
    std::ptrdiff_t number = -1;
    const V* source = nullptr;
    for (std::ptrdiff_t i = 0; i < edge_[0]; ++i) {
      node[0] = inside(field.lattice(), 0, first[0] + i);
      if (node[0] / extent != block) {
        block = node[0] / extent;
        number = field.find(Storage::block_of(node));
        Index<D> start = node;
        start[0] = block * extent;
        source = number < 0 ? nullptr : field.block(static_cast<std::size_t>(number)).data() + Storage::offset(start);
      }
      for (int c = 0; c < Components<V>::count; ++c) {
        values_[static_cast<std::size_t>(c)][static_cast<std::size_t>(row + i)] =
            source ? component(source[node[0] - block * extent], c) : T(0);
      }
      if (!source) unknown_.push_back(static_cast<std::size_t>(row + i));
    }
  }
  void continue_constant(const Index<D>& first) {
    known_.assign(static_cast<std::size_t>(product(edge_)), true);
    if (unknown_.size() == known_.size()) {
      throw InterfaceError(detail::message("the field is not stored at any of the ", edge_, " nodes from node ", first,
                                           " on, which are near the interface: give it the blocks of the band"));
    }
    for (const std::size_t i : unknown_) known_[i] = false;
    while (!unknown_.empty()) {
      for (int d = 0; d < D; ++d) {
        const auto pitch = static_cast<std::size_t>(stride_[d]);
        const auto edge = static_cast<std::size_t>(edge_[d]);
        for (const std::size_t i : unknown_) {
          if (i / pitch % edge > 0) carry(i - pitch, i);
        }
        for (std::size_t k = unknown_.size(); k-- > 0;) {
          const std::size_t i = unknown_[k];
          if (i / pitch % edge + 1 < edge) carry(i + pitch, i);
        }
      }
      std::erase_if(unknown_, [&](std::size_t i) { return bool{known_[i]}; });
    }
  }
  void carry(std::size_t from, std::size_t to) {
    if (known_[to] || !known_[from]) return;
    for (auto& column : values_) column[to] = column[from];
    known_[to] = true;
  }

  Index<D> edge_{};
  Index<D> stride_{};
  std::vector<AlignedVector<T>> values_;
  std::vector<std::size_t> unknown_;  ///< nodes not stored, ascending
  std::vector<bool> known_;
};

}  // namespace cambium
