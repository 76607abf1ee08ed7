// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <cambium/levelset/narrow_band.hpp>

namespace cambium::detail {

/// Which blocks of a band matter while phi changes by steps of less than a spacing: those with a node in the band, and
/// those next to them. One mark for each block of each of three buffers.
template <class T, int D>
class BlockActivity {
 public:
  using Band = NarrowBand<T, D>;

  /// Finds the neighbours of all blocks, and marks those of buffer 0, which is the band.
  template <Execution E>
  void start(const Band& band, const E& execution) {
    for (auto& marks : inner_) marks.resize(band.blocks());
    neighbours_.resize(band.blocks());
    for_each_piece(execution, band.blocks(), 1, [&](std::size_t b, std::size_t) {
      neighbours_[b].fill(static_cast<std::int32_t>(b));
      band.for_each_neighbour(band.values().block_index(b), [&](const Index<D>& block, int axis, int way) {
        const std::ptrdiff_t other = band.values().find(block);
        if (other < 0) return;
        neighbours_[b][static_cast<std::size_t>(2 * axis + (way > 0 ? 1 : 0))] = static_cast<std::int32_t>(other);
      });
      note(0, b, band);
    });
  }
  /// Marks block b of a buffer.
  void note(std::size_t buffer, std::size_t b, const Band& band) {
    const auto in_band = [&](T phi) { return band.in_band(phi); };
    inner_[buffer][b] = std::ranges::any_of(band.values().block(b), in_band) ? 1 : 0;
  }
  /// True if block b of a buffer, or one across a face of it, has a node in the band.
  bool operator()(std::size_t buffer, std::size_t b) const {
    const auto marked = [&](std::int32_t other) { return inner_[buffer][static_cast<std::size_t>(other)] != 0; };
    return inner_[buffer][b] != 0 || std::ranges::any_of(neighbours_[b], marked);
  }

 private:
  std::vector<std::array<std::int32_t, 2 * D>> neighbours_;
  std::array<std::vector<std::uint8_t>, 3> inner_;
};

}  // namespace cambium::detail
