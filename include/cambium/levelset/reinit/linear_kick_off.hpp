// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <cambium/levelset/reinit/crossed_nodes.hpp>
#include <cambium/levelset/reinit/kick_off.hpp>

namespace cambium {

/// The classic kick-off: a node at distances d_1, ..., d_D from the crossings of the lattice lines through it (linear
/// between nodes) is at 1 / sqrt(sum 1 / d^2) from the plane through them (Sethian 1999, section 11.4).
///
/// First order: a line that the interface crosses just beyond the next node counts as not crossed, so that distances
/// may be off by 0.4 spacings on any lattice.
struct LinearKickOff {
  struct Params {};

  template <class T, int D>
  class Method {
   public:
    Method() = default;
    explicit Method(const Params&) {}

    /// Distances of the nodes with a neighbour along an axis on the other side.
    template <Execution E>
    KickOffCounts operator()(const NarrowBand<T, D>& band, std::span<T> distance, const E& execution) {
      patches_.resize(static_cast<std::size_t>(execution.count()));
      found_.assign(band.blocks(), 0);
      signs_.find(band, execution);
      for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
        detail::CrossedNodes<T, D> crossed;
        if (!crossed.template find<detail::Beside::edge>(band, signs_, b)) return;
        Patch<T, D>& patch = patches_[worker];
        patch.read_block(band, b, 1);
        crossed.for_each([&](std::size_t i) {
          const std::ptrdiff_t at = patch.entry(i);
          Vec<D, T> inverse;
          T length{};
          if (patch[at] != T(0) && detail::inverse_crossings(patch, at, inverse)) length = T(1) / norm(inverse);
          distance[b * NarrowBand<T, D>::volume + i] = detail::on_side_of(patch[at], length);
          ++found_[b];
        });
      });
      KickOffCounts counts;
      for (const std::size_t found : found_) counts.nodes += found;
      return counts;
    }

   private:
    detail::SignRows<T, D> signs_;
    std::vector<Patch<T, D>> patches_;
    std::vector<std::size_t> found_;
  };
};

}  // namespace cambium
