// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <cambium/core/sparse.hpp>
#include <cambium/parallel/execution.hpp>

namespace cambium {

/// There is no interface, or it touches the box.
class InterfaceError : public Error {
 public:
  using Error::Error;
};

/// The interface leaves the nodes that values are kept for: a step was too long for the band.
class BandError : public InterfaceError {
 public:
  using InterfaceError::InterfaceError;
};

/// Values of a level set near its interface, in blocks of nodes, and the side on which every other node lies.
///
/// phi < 0 inside. Nodes whose distance to the interface is below half_width() are in the band; all others, in blocks
/// or not, read as -half_width() or +half_width(). Memory grows with the area of the interface (and one byte and one
/// 4-byte entry for every possible block).
template <class T, int D>
class NarrowBand {
 public:
  using Scalar = T;
  using Shape = BlockShape<D>;
  static constexpr int dimension = D;
  static constexpr std::ptrdiff_t extent = Shape::extent;
  static constexpr std::size_t volume = Shape::volume;

  /// \param half_width  in length units. \throws ValueError unless it is positive and finite
  NarrowBand(const Lattice<D>& lattice, double half_width)
      : values_(lattice, static_cast<T>(half_width)),
        far_side_(static_cast<std::size_t>(product(values_.block_grid())), std::int8_t{1}) {
    if (!(half_width > 0.0) || !std::isfinite(half_width)) {
      throw ValueError(detail::message("half width of the band is ", half_width, ": it must be a positive length"));
    }
  }

  const Lattice<D>& lattice() const { return values_.lattice(); }
  double spacing() const { return lattice().spacing(); }
  T half_width() const { return values_.background(); }

  /// Values of the nodes in blocks.
  Field<T, D, Sparse>& values() { return values_; }
  const Field<T, D, Sparse>& values() const { return values_; }
  std::size_t blocks() const { return values_.blocks(); }
  bool in_band(T phi) const { return std::abs(phi) < half_width(); }

  /// Value at a node of the lattice.
  T operator()(const Index<D>& node) const {
    const Index<D> block = values_.block_of(node);
    const std::ptrdiff_t b = values_.find(block);
    return b < 0 ? far_value(block) : values_.block(static_cast<std::size_t>(b))[values_.offset(node)];
  }
  /// Value of all nodes of a block that is not stored.
  T far_value(const Index<D>& block) const { return far_side_[entry(block)] < 0 ? -half_width() : half_width(); }

  /// Node brought into the lattice: wrapped on periodic axes, moved to the face on bounded ones.
  Index<D> inside(Index<D> node) const {
    for (int d = 0; d < D; ++d) {
      node[d] = lattice().periodic(d) ? lattice().wrap(d, node[d])
                                      : std::clamp<std::ptrdiff_t>(node[d], 0, lattice().nodes()[d] - 1);
    }
    return node;
  }

  /// Finds the side of all blocks that are not stored: that of the stored nodes next to them, carried from block to
  /// block. \throws InterfaceError if there is no block, BandError if the interface runs into one that is not stored
  void find_far_sides() {
    if (blocks() == 0) {
      throw InterfaceError(
          "the level set has no zero crossing: there is no interface; check the shape and the lattice");
    }
    std::fill(far_side_.begin(), far_side_.end(), std::int8_t{0});
    front_.clear();
    for (std::size_t b = 0; b < blocks(); ++b) far_side_[entry(values_.block_index(b))] = 1;
    for (std::size_t b = 0; b < blocks(); ++b) {
      for_each_neighbour(values_.block_index(b), [&](const Index<D>& block, int axis, int way) {
        if (values_.find(block) < 0) claim(block, side_of_face(b, axis, way));
      });
    }
    while (!front_.empty()) {
      const Index<D> from = front_.back();
      front_.pop_back();
      for_each_neighbour(from, [&](const Index<D>& block, int, int) {
        if (values_.find(block) < 0) claim(block, far_side_[entry(from)]);
      });
    }
  }

  /// Calls f(block, axis, way) for the blocks next to `block` across its faces, way = -1 or 1; periodic axes wrap.
  template <class F>
  void for_each_neighbour(const Index<D>& block, F&& f) const {
    for (int axis = 0; axis < D; ++axis) {
      for (const int way : {-1, 1}) {
        Index<D> next = block;
        next[axis] += way;
        const std::ptrdiff_t count = values_.block_grid()[axis];
        if (next[axis] < 0 || next[axis] >= count) {
          if (!lattice().periodic(axis)) continue;
          next[axis] = next[axis] < 0 ? count - 1 : 0;
        }
        f(next, axis, way);
      }
    }
  }

 private:
  std::size_t entry(const Index<D>& block) const {
    std::ptrdiff_t n = block[D - 1];
    for (int d = D - 2; d >= 0; --d) n = n * values_.block_grid()[d] + block[d];
    return static_cast<std::size_t>(n);
  }
  void claim(const Index<D>& block, std::int8_t side) {
    std::int8_t& known = far_side_[entry(block)];
    if (known == 0) {
      known = side;
      front_.push_back(block);
    } else if (known != side) {
      throw BandError(detail::message("the interface runs through block ", block,
                                      " where no values are kept: the band is too thin for the step; take "
                                      "shorter steps or a wider band"));
    }
  }
  /// Side of the nodes of a stored block next to one of its faces.
  std::int8_t side_of_face(std::size_t b, int axis, int way) const {
    const Index<D> origin = values_.block_origin(b);
    std::int8_t side = 0;
    for (std::size_t i = 0; i < volume; ++i) {
      const Index<D> node = values_.node(b, i);
      if (!lattice().contains(node)) continue;
      const std::ptrdiff_t last = std::min(origin[axis] + extent, lattice().nodes()[axis]) - 1;
      if (node[axis] != (way < 0 ? origin[axis] : last)) continue;
      const std::int8_t here = values_.block(b)[i] < T(0) ? -1 : 1;
      if (side != 0 && here != side) {
        throw BandError(detail::message("the interface leaves the stored blocks at node ", node,
                                        ": the band is too thin for the step; take shorter steps or a wider band"));
      }
      side = here;
    }
    return side;
  }

  Field<T, D, Sparse> values_;
  std::vector<std::int8_t> far_side_;
  std::vector<Index<D>> front_;  ///< of find_far_sides()
};

}  // namespace cambium
