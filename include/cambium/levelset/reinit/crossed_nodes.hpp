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

/// Signs of the nodes in the blocks of a band, a row of a block in one word.
template <class T, int D>
class SignRows {
 public:
  using Band = NarrowBand<T, D>;
  using Word = std::uint32_t;
  static constexpr std::size_t rows = Band::volume / Band::extent;

  template <Execution E>
  void find(const Band& band, const E& execution) {
    negative_.resize(band.blocks() * rows);
    side_.resize(band.blocks());
    for_each_piece(execution, band.blocks(), 1, [&](std::size_t b, std::size_t) {
      const T* phi = band.values().block(b).data();
      Word any = 0;
      Word all = whole;
      for (std::size_t r = 0; r < rows; ++r, phi += Band::extent) {
        Word mask = 0;
        for (int x = 0; x < Band::extent; ++x) mask |= static_cast<Word>(phi[x] < T(0)) << x;
        negative_[b * rows + r] = mask;
        any |= mask;
        all &= mask;
      }
      side_[b] = any == 0 ? 1 : all == whole ? -1 : 0;
    });
  }
  /// Bit x is set if node x of row r of block b is negative.
  Word row(std::size_t b, std::size_t r) const { return negative_[b * rows + r]; }
  /// The side of all nodes of block b, 0 if they are on both.
  int side(std::size_t b) const { return side_[b]; }

 private:
  static constexpr Word whole = (Word{1} << Band::extent) - 1;

  std::vector<Word> negative_;
  std::vector<std::int8_t> side_;
};

/// Which nodes count as next to the interface.
enum class Beside {
  edge,  ///< nodes with a neighbour along an axis on the other side
  cell   ///< corners of the cells that the interface crosses
};

/// The nodes of a block that are next to the interface.
template <class T, int D>
class CrossedNodes {
 public:
  using Band = NarrowBand<T, D>;

  /// Looks at block b and the nodes around it. \return true if there is such a node
  template <Beside By>
  bool find(const Band& band, const SignRows<T, D>& signs, std::size_t b) {
    if (!read_neighbours(band, signs, b)) return false;
    for (int d = 0; d < D; ++d) {
      size_[d] = std::min<std::ptrdiff_t>(Band::extent, band.lattice().nodes()[d] - band.values().block_origin(b)[d]);
    }
    read_rows(band, signs);
    const std::uint32_t on_lattice = ((1U << size_[0]) - 1U) << 1;
    std::uint32_t any = 0;
    for (std::ptrdiff_t r = 0; r < static_cast<std::ptrdiff_t>(crossed_.size()); ++r) {
      std::uint32_t& crossed = crossed_[static_cast<std::size_t>(r)];
      crossed = 0;
      const std::ptrdiff_t y = r % Band::extent;
      const std::ptrdiff_t z = r / Band::extent;
      if (y >= size_[1] || (D == 3 && z >= size_[D - 1])) continue;
      const std::ptrdiff_t row = y + 1 + (D == 3 ? (z + 1) * row_nodes : 0);
      crossed = (By == Beside::edge ? across_edges(row) : across_cells(row)) & on_lattice;
      any |= crossed;
    }
    return any != 0;
  }
  /// Calls f(i) for the nodes found last.
  template <class F>
  void for_each(F&& f) const {
    for (std::size_t r = 0; r < crossed_.size(); ++r) {
      for (std::uint32_t rest = crossed_[r]; rest != 0; rest &= rest - 1) {
        f(r * Band::extent + static_cast<std::size_t>(std::countr_zero(rest)) - 1);
      }
    }
  }

 private:
  static constexpr std::ptrdiff_t row_nodes = Band::extent + 2;
  static constexpr std::ptrdiff_t rows = D == 2 ? row_nodes : row_nodes * row_nodes;
  static constexpr std::uint32_t whole = (1U << row_nodes) - 1U;
  static constexpr int around = D == 2 ? 9 : 27;

  /// The 3^D blocks around block b. \return false if all their nodes are on one side
  bool read_neighbours(const Band& band, const SignRows<T, D>& signs, std::size_t b) {
    bool both = signs.side(b) == 0;
    const Index<D>& grid = band.values().block_grid();
    for (int k = 0; k < around; ++k) {
      Index<D> block = band.values().block_index(b);
      for (int d = 0, rest = k; d < D; ++d, rest /= 3) {
        block[d] += rest % 3 - 1;
        if (band.lattice().periodic(d)) {
          block[d] = block[d] < 0 ? grid[d] - 1 : block[d] >= grid[d] ? 0 : block[d];
        } else {
          block[d] = std::clamp<std::ptrdiff_t>(block[d], 0, grid[d] - 1);
        }
      }
      const std::ptrdiff_t found = band.values().find(block);
      block_[k] = found;
      far_negative_[k] = found < 0 && band.far_value(block) < T(0);
      const int side = found < 0 ? (far_negative_[k] ? -1 : 1) : signs.side(static_cast<std::size_t>(found));
      both |= side != signs.side(b);
      for (int d = 0; d < D; ++d) last_[k][d] = last_node(band, block, d);
    }
    return both;
  }
  static std::ptrdiff_t last_node(const Band& band, const Index<D>& block, int d) {
    return std::min<std::ptrdiff_t>(Band::extent, band.lattice().nodes()[d] - block[d] * Band::extent) - 1;
  }
  /// Signs of the block with one node around it; beyond a bounded face those on the face.
  void read_rows(const Band& band, const SignRows<T, D>& signs) {
    for (std::ptrdiff_t r = 0; r < rows; ++r) {
      const std::ptrdiff_t at[2] = {r % row_nodes - 1, r / row_nodes - 1};
      int which = 1;  // of the blocks around, in the middle along axis 0
      std::size_t row = 0;
      for (int d = 1, pitch = 1, side = 3; d < D; ++d, pitch *= static_cast<int>(Band::extent), side *= 3) {
        std::ptrdiff_t y = at[d - 1];
        const int way = y < 0 ? 0 : y < size_[d] ? 1 : 2;
        which += way * side;
        if (way != 1) y = beyond(band, which_along(d, way), d, way);
        row += static_cast<std::size_t>(y * pitch);
      }
      const std::uint32_t low = row_of(signs, which - 1, row) >> beyond(band, which_along(0, 0), 0, 0) & 1U;
      const std::uint32_t high = row_of(signs, which + 1, row) >> beyond(band, which_along(0, 2), 0, 2) & 1U;
      const std::uint32_t middle = row_of(signs, which, row) & ((1U << size_[0]) - 1U);
      negative_[static_cast<std::size_t>(r)] = low | middle << 1 | high << (size_[0] + 1);
    }
  }
  /// Number among the blocks around of the one across a face.
  static constexpr int which_along(int axis, int way) {
    int pitch = 1;
    for (int d = 0; d < axis; ++d) pitch *= 3;
    return around / 2 + (way - 1) * pitch;
  }
  /// Index, in the block across a face, of the nodes next to that face: of a bounded face the block itself.
  std::ptrdiff_t beyond(const Band& band, int which, int d, int way) const {
    const bool itself = block_[which] == block_[around / 2] && !band.lattice().periodic(d);
    return (way == 0) != itself ? last_[which][d] : 0;
  }
  std::uint32_t row_of(const SignRows<T, D>& signs, int which, std::size_t row) const {
    if (block_[which] < 0) return far_negative_[which] ? whole : 0U;
    return signs.row(static_cast<std::size_t>(block_[which]), row);
  }

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

  Index<D> size_{};
  std::array<std::ptrdiff_t, around> block_{};
  std::array<bool, around> far_negative_{};
  std::array<Index<D>, around> last_{};
  std::array<std::uint32_t, static_cast<std::size_t>(rows)> negative_;
  std::array<std::uint32_t, SignRows<T, D>::rows> crossed_;
};

/// Inverse signed distances, in spacings, from an entry of a patch to the crossings of the lattice lines through it
/// (linear between nodes); of two along one axis the nearer one, 0 along an axis without one. The value is not 0.
/// \return false if no line is crossed
template <class T, int D>
bool inverse_crossings(const Patch<T, D>& patch, std::ptrdiff_t at, Vec<D, T>& inverse) {
  const T here = patch[at];
  const T over_here = T(1) / here;
  bool crossed = false;
  inverse = {};
  for (int d = 0; d < D; ++d) {
    for (const int way : {-1, 1}) {
      const T there = patch[at + way * patch.stride()[d]];
      if ((here < T(0)) == (there < T(0))) continue;
      crossed = true;
      const T step = T(1) - there * over_here;
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
