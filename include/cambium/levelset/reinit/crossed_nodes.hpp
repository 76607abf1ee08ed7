// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <cambium/levelset/patch.hpp>

namespace cambium::detail {

/// On which sides of the interface the nodes of blocks are, to pass over blocks far from it without a look at their
/// neighbours' nodes.
template <class T, int D>
class BlockSides {
 public:
  using Band = NarrowBand<T, D>;

  template <Execution E>
  void find(const Band& band, const E& execution) {
    side_.resize(band.blocks());
    for_each_piece(execution, band.blocks(), 1, [&](std::size_t b, std::size_t) {
      int negative = 0;
      for (const T phi : band.values().block(b)) negative += phi < T(0);
      side_[b] = negative == 0 ? 1 : negative == static_cast<int>(Band::volume) ? -1 : 0;
    });
  }
  /// False if all nodes of block b, and of the blocks around it, are on the same side.
  bool may_cross(const Band& band, std::size_t b) const {
    const std::int8_t side = side_[b];
    if (side == 0) return true;
    const Index<D>& block = band.values().block_index(b);
    const Index<D>& grid = band.values().block_grid();
    for (int k = 0; k < (D == 2 ? 9 : 27); ++k) {
      Index<D> next = block;
      bool exists = true;
      for (int d = 0, rest = k; d < D; ++d, rest /= 3) {
        next[d] += rest % 3 - 1;
        if (next[d] >= 0 && next[d] < grid[d]) continue;
        exists &= band.lattice().periodic(d);
        next[d] = next[d] < 0 ? grid[d] - 1 : 0;
      }
      if (!exists) continue;
      const std::ptrdiff_t found = band.values().find(next);
      if (found < 0 ? (band.far_value(next) < T(0)) != (side < 0) : side_[static_cast<std::size_t>(found)] != side) {
        return true;
      }
    }
    return false;
  }

 private:
  std::vector<std::int8_t> side_;
};

/// Which nodes count as next to the interface.
enum class Beside {
  edge,  ///< nodes with a neighbour along an axis on the other side
  cell   ///< corners of the cells that the interface crosses
};

/// Finds the nodes of a block that are next to the interface, a row of signs in one word.
template <class T, int D>
class CrossedNodes {
 public:
  using Band = NarrowBand<T, D>;

  /// \param patch  block b with one node or more around it. \return false if all its values are of one side
  bool read(const Patch<T, D>& patch) {
    std::uint32_t any = 0;
    std::uint32_t all = whole;
    const Index<D>& edge = patch.edge();
    const std::ptrdiff_t skip = (edge[0] - row_nodes) / 2;
    for (std::ptrdiff_t r = 0; r < rows; ++r) {
      std::ptrdiff_t at = skip;
      std::ptrdiff_t rest = r;
      for (int d = 1; d < D; ++d) {
        at += (skip + rest % row_nodes) * patch.stride()[d];
        rest /= row_nodes;
      }
      const T* row = patch.data() + at;
      std::uint32_t mask = 0;
      for (int x = 0; x < row_nodes; ++x) mask |= static_cast<std::uint32_t>(row[x] < T(0)) << x;
      negative_[static_cast<std::size_t>(r)] = mask;
      any |= mask;
      all &= mask;
    }
    return any != 0 && all != whole;
  }
  /// Calls f(i) for the nodes of block b, which was read last, that are next to the interface and on the lattice.
  template <Beside beside, class F>
  void for_each(const Band& band, std::size_t b, F&& f) const {
    Index<D> size;
    for (int d = 0; d < D; ++d) {
      size[d] = std::min<std::ptrdiff_t>(Band::extent, band.lattice().nodes()[d] - band.values().block_origin(b)[d]);
    }
    const std::uint32_t on_lattice = ((1U << size[0]) - 1U) << 1;
    for (std::ptrdiff_t r = 0; r < product(size) / size[0]; ++r) {
      const std::ptrdiff_t y = r % size[1];
      const std::ptrdiff_t z = D == 3 ? r / size[1] : 0;
      const std::ptrdiff_t row = y + 1 + (D == 3 ? (z + 1) * row_nodes : 0);
      const auto first = static_cast<std::size_t>((y + z * Band::extent) * Band::extent);
      std::uint32_t crossed = (beside == Beside::edge ? across_edges(row) : across_cells(row)) & on_lattice;
      for (; crossed != 0; crossed &= crossed - 1) f(first + static_cast<std::size_t>(std::countr_zero(crossed)) - 1);
    }
  }

 private:
  static constexpr std::ptrdiff_t row_nodes = Band::extent + 2;
  static constexpr std::ptrdiff_t rows = D == 2 ? row_nodes : row_nodes * row_nodes;
  static constexpr std::uint32_t whole = (1U << row_nodes) - 1U;

  std::uint32_t negative(std::ptrdiff_t row) const { return negative_[static_cast<std::size_t>(row)]; }
  static std::uint32_t beside_in_row(std::uint32_t mask) { return mask << 1 | mask >> 1; }

  std::uint32_t across_edges(std::ptrdiff_t row) const {
    const std::uint32_t here = negative(row);
    std::uint32_t low = beside_in_row(here);
    std::uint32_t high = beside_in_row(~here & whole);
    for (std::ptrdiff_t pitch = 1, d = 1; d < D; ++d, pitch *= row_nodes) {
      low |= negative(row - pitch) | negative(row + pitch);
      high |= ~negative(row - pitch) | ~negative(row + pitch);
    }
    return (here & high) | (~here & low);
  }
  std::uint32_t across_cells(std::ptrdiff_t row) const {
    const std::uint32_t here = negative(row);
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    const std::ptrdiff_t out = D == 3 ? row_nodes : 0;
    for (std::ptrdiff_t z = -out; z <= out; z += row_nodes) {
      for (std::ptrdiff_t y = -1; y <= 1; ++y) {
        low |= negative(row + z + y);
        high |= ~negative(row + z + y) & whole;
      }
    }
    return (here & (high | beside_in_row(high))) | (~here & (low | beside_in_row(low)));
  }

  std::array<std::uint32_t, static_cast<std::size_t>(rows)> negative_;
};

/// Inverse signed distances, in spacings, from an entry of a patch to the crossings of the lattice lines through it
/// (linear between nodes); of two along one axis the nearer one, 0 along an axis without one. The value is not 0.
/// \return false if no line is crossed
template <class T, int D>
bool inverse_crossings(const Patch<T, D>& patch, std::ptrdiff_t at, Vec<D, T>& inverse) {
  const T here = patch[at];
  bool crossed = false;
  inverse = {};
  for (int d = 0; d < D; ++d) {
    for (const int way : {-1, 1}) {
      const T there = patch[at + way * patch.stride()[d]];
      if ((here < T(0)) == (there < T(0))) continue;
      crossed = true;
      const T step = T(1) - there / here;
      if (step > std::abs(inverse[d])) inverse[d] = static_cast<T>(way) * step;
    }
  }
  return crossed;
}

/// `distance` with the sign of phi, never zero where phi is negative, so that the node stays on its side.
template <class T>
T on_side_of(T phi, T distance) {
  return phi < T(0) ? -std::max(distance, std::numeric_limits<T>::min()) : distance;
}

}  // namespace cambium::detail
