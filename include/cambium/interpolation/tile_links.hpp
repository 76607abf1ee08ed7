// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <cambium/core/sparse.hpp>
#include <cambium/interpolation/closure.hpp>

namespace cambium::detail {

/// Which nodes of the lattice the padded nodes of a tile stand for, and with what weight: several for one where the
/// closure of a bounded face reaches in.
template <class K, class T, int D>
class TileLinks {
 public:
  static constexpr std::ptrdiff_t extent = BlockShape<D>::extent;
  static constexpr std::ptrdiff_t padded = extent + K::support - 1;
  /// Links along an axis at most.
  static constexpr std::size_t most = static_cast<std::size_t>(padded + K::support * (K::moments + 1));

  /// Padded node of a tile along one axis, and a node of the lattice that it stands for.
  struct Link {
    std::ptrdiff_t padded;
    std::ptrdiff_t node;
    T weight;
  };
  /// Links along one axis, in the order of padded nodes.
  struct Axis {
    std::array<Link, most> link;
    std::size_t count = 0;
  };

  /// Links of a tile with these cells, along the axes that a lower dimension lacks the one link 0 -> 0.
  /// \param target  block to whose nodes they lead, or nullptr for all
  TileLinks(const Lattice<D>& lattice, const CellBox<D>& cells, const Index<D>* target = nullptr) {
    for (int d = 0; d < 3; ++d) {
      if (d < D) {
        axes_[d] = along(lattice, cells, d, target ? (*target)[d] : -1);
      } else {
        axes_[d].link[0] = {0, 0, T(1)};
        axes_[d].count = 1;
      }
    }
  }

  const Axis& axis(int d) const { return axes_[d]; }

  /// Blocks that the links along an axis lead to, each once, in the order of the first link to it.
  struct Blocks {
    std::array<std::ptrdiff_t, most> block;
    std::size_t count = 0;
    const std::ptrdiff_t* begin() const { return block.data(); }
    const std::ptrdiff_t* end() const { return block.data() + count; }
  };
  Blocks blocks(int d) const {
    Blocks blocks;
    for (std::size_t i = 0; i < axes_[d].count; ++i) {
      const std::ptrdiff_t block = axes_[d].link[i].node / extent;
      if (std::find(blocks.begin(), blocks.end(), block) == blocks.end()) blocks.block[blocks.count++] = block;
    }
    return blocks;
  }

  /// Calls f(plane, row, node, weight) for the links along all axes but the first.
  template <class F>
  void for_each_row(F&& f) const {
    for (std::size_t l = 0; l < axes_[2].count; ++l) {
      for (std::size_t m = 0; m < axes_[1].count; ++m) {
        const Link& middle = axes_[1].link[m];
        const Link& last = axes_[2].link[l];
        const auto plane = static_cast<std::size_t>(D == 3 ? last.padded : middle.padded);
        const auto row = static_cast<std::size_t>(D == 3 ? middle.padded : 0);
        f(plane, row, Index<3>{0, middle.node, last.node}, middle.weight * last.weight);
      }
    }
  }

 private:
  /// Links along an axis, only those to nodes in block `target` unless it is negative.
  static Axis along(const Lattice<D>& lattice, const CellBox<D>& cells, int axis, std::ptrdiff_t target) {
    Axis result;
    const Closure<K> close(lattice, axis);
    for (std::ptrdiff_t i = 0; i < cells.count[axis] + K::support - 1; ++i) {
      close(cells.first[axis] + i - Taps<K>::before, [&](std::ptrdiff_t node, double w) {
        if (target >= 0 && node / extent != target) return;
        result.link[result.count++] = {i, node, static_cast<T>(w)};
      });
    }
    return result;
  }

  std::array<Axis, 3> axes_;
};

}  // namespace cambium::detail
