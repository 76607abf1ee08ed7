// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <cambium/levelset/narrow_band.hpp>

namespace cambium::detail {

/// Neighbours along the axes of the nodes in the blocks of a band: node i of block b has the number b * volume + i.
///
/// A step is an offset, the same for the nodes at one place of every block, from one of 2 D + 1 origins that every
/// block has: itself, and the blocks across its faces. Where there is no block, numbers from end() on come out.
template <int D>
class BlockLinks {
 public:
  using Number = std::int32_t;
  using Shape = BlockShape<D>;
  /// Way 2 d is down axis d, way 2 d + 1 up.
  static constexpr int ways = 2 * D;

  template <class T>
  void build(const NarrowBand<T, D>& band) {
    if (band.blocks() >= std::numeric_limits<Number>::max() / Shape::volume) {
      throw SizeError(message("band of ", band.blocks(), " blocks has more nodes than 32 bits number: take a narrower ",
                              "band or a coarser lattice"));
    }
    end_ = static_cast<Number>(band.blocks() * Shape::volume);
    const Lattice<D>& lattice = band.lattice();
    for (int d = 0; d < D; ++d) {
      const std::ptrdiff_t rest = lattice.nodes()[d] % Shape::extent;
      thickness_[d] = lattice.periodic(d) && rest != 0 ? rest : Shape::extent;
    }
    build_steps();
    origin_.assign(band.blocks() * (ways + 1), end_);
    kind_.assign(band.blocks(), 0);
    for (std::size_t b = 0; b < band.blocks(); ++b) link_block(band, b);
  }

  /// One more than the largest number of a node.
  Number end() const { return end_; }
  /// Numbers that next() gives are below this.
  std::size_t size() const { return static_cast<std::size_t>(end_) + Shape::volume; }

  /// The neighbours of one node.
  class Around {
   public:
    Number next(int way) const {
      const Step step = step_[way];
      return origin_[step.from] + step.offset;
    }

   private:
    friend class BlockLinks;
    struct Step {
      std::int16_t offset;
      std::int16_t from;
    };
    Around(const Number* origin, const Step* step) : origin_(origin), step_(step) {}
    const Number* origin_;
    const Step* step_;
  };
  Around around(Number n) const {
    const auto b = static_cast<std::size_t>(n) / Shape::volume;
    const auto i = static_cast<std::size_t>(n) % Shape::volume;
    return {origin_.data() + b * (ways + 1), steps_.data() + (kind_[b] * Shape::volume + i) * ways};
  }

 private:
  using Step = typename Around::Step;

  /// Kind of a block: bit d is set if it is the last one of a periodic axis d and thinner than the others.
  void build_steps() {
    steps_.resize((std::size_t{1} << D) * Shape::volume * ways);
    std::size_t entry = 0;
    for (unsigned kind = 0; kind < 1U << D; ++kind) {
      for (std::size_t i = 0; i < Shape::volume; ++i) {
        std::ptrdiff_t pitch = 1;
        for (int d = 0; d < D; ++d, pitch *= Shape::extent) {
          const auto at = static_cast<std::ptrdiff_t>(i) / pitch % Shape::extent;
          const std::ptrdiff_t last = (kind >> d & 1U ? thickness_[d] : Shape::extent) - 1;
          const auto here = static_cast<std::ptrdiff_t>(i);
          steps_[entry++] = at > 0 ? step(here - pitch, 0) : step(here + (Shape::extent - 1) * pitch, 1 + 2 * d);
          steps_[entry++] = at != last ? step(here + (at < last ? pitch : 0), 0) : step(here - at * pitch, 2 + 2 * d);
        }
      }
    }
  }
  static Step step(std::ptrdiff_t offset, int from) {
    return {static_cast<std::int16_t>(offset), static_cast<std::int16_t>(from)};
  }
  template <class T>
  void link_block(const NarrowBand<T, D>& band, std::size_t b) {
    Number* origin = origin_.data() + b * (ways + 1);
    const Index<D>& block = band.values().block_index(b);
    origin[0] = static_cast<Number>(b * Shape::volume);
    for (int d = 0; d < D; ++d) {
      if (thin(band, block, d)) kind_[b] = static_cast<std::uint8_t>(kind_[b] | 1U << d);
    }
    band.for_each_neighbour(block, [&](const Index<D>& next, int axis, int way) {
      const std::ptrdiff_t found = band.values().find(next);
      if (found < 0) return;
      std::ptrdiff_t at = found * static_cast<std::ptrdiff_t>(Shape::volume);
      // Steps down expect the last node of the block where that of a whole block is.
      if (way < 0 && thin(band, next, axis)) {
        for (std::ptrdiff_t pitch = 1, d = 0; d <= axis; ++d, pitch *= Shape::extent) {
          if (d == axis) at -= (Shape::extent - thickness_[axis]) * pitch;
        }
      }
      origin[1 + 2 * axis + (way > 0 ? 1 : 0)] = static_cast<Number>(at);
    });
  }
  template <class T>
  bool thin(const NarrowBand<T, D>& band, const Index<D>& block, int d) const {
    return thickness_[d] < Shape::extent && block[d] == band.values().block_grid()[d] - 1;
  }

  Number end_ = 0;
  Index<D> thickness_{};
  std::vector<Step> steps_;
  std::vector<Number> origin_;
  std::vector<std::uint8_t> kind_;
};

}  // namespace cambium::detail
