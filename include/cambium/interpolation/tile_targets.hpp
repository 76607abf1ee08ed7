// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include <cambium/core/sparse.hpp>
#include <cambium/interpolation/sparse_tiles.hpp>
#include <cambium/interpolation/tile_links.hpp>

namespace cambium::detail {

/// The blocks of nodes that tiles reach, and for each the tiles that reach it, in their order.
class TileTargets {
 public:
  /// Activates, in a mesh that is cleared, the blocks that tiles of kernel K reach.
  template <class K, class T, class P, class V, int D>
  void list(const SparseTiles<K, P, D>& tiles, std::type_identity<T>, Field<V, D, Sparse>& mesh) {
    mesh.clear();
    reached_.clear();
    for (std::size_t k = 0; k < tiles.size(); ++k) {
      const TileLinks<K, T, D> links(tiles.lattice(), tiles.cells_of(k));
      const auto first = links.blocks(0), middle = links.blocks(1), last = links.blocks(2);
      for (const std::ptrdiff_t z : last) {
        for (const std::ptrdiff_t y : middle) {
          for (const std::ptrdiff_t x : first) {
            const std::array<std::ptrdiff_t, 3> all{x, y, z};
            Index<D> block;
            for (int d = 0; d < D; ++d) block[d] = all[d];
            reached_.push_back({static_cast<std::uint32_t>(mesh.activate(block)), static_cast<std::uint32_t>(k)});
          }
        }
      }
    }
    sort(mesh.blocks());
  }
  /// Tiles that reach block b of the mesh.
  std::span<const std::uint32_t> sources(std::size_t b) const {
    return std::span(sources_).subspan(first_source_[b], first_source_[b + 1] - first_source_[b]);
  }

 private:
  struct Reached {
    std::uint32_t block;
    std::uint32_t tile;
  };

  void sort(std::size_t blocks) {
    first_source_.assign(blocks + 1, 0);
    for (const auto& [block, tile] : reached_) ++first_source_[block + 1];
    for (std::size_t b = 0; b < blocks; ++b) first_source_[b + 1] += first_source_[b];
    sources_.resize(reached_.size());
    next_.assign(first_source_.begin(), first_source_.end());
    for (const auto& [block, tile] : reached_) sources_[next_[block]++] = tile;
  }

  std::vector<Reached> reached_;
  std::vector<std::uint32_t> first_source_;
  std::vector<std::uint32_t> sources_;
  std::vector<std::uint32_t> next_;
};

}  // namespace cambium::detail
