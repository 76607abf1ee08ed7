// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include <cambium/levelset/reinit/chopp_kick_off.hpp>
#include <cambium/levelset/reinit/distance_field.hpp>

namespace cambium {

/// Reinitialisation by fast sweeping (Zhao 2005, "A fast sweeping method for eikonal equations"): Gauss-Seidel
/// iteration of the upwind scheme of first order, in orders that alternate between the 2^D diagonals of the lattice.
///
/// On the blocks of a band an order runs block by block, and node by node in a block, which visits upwind nodes first
/// just as well. Nodes none of whose neighbours have changed since they were visited last are passed over (locked, as
/// Bak, McLaughlin and Renzi 2010 call it): they would not change. Sweeps stop when no such node is left: the scheme is
/// then satisfied to rounding, and the result is that of FastMarching of first order. Only the kick-off runs on several
/// threads.
template <class Start = ChoppKickOff>
struct FastSweeping {
  struct Params {
    typename Start::Params kick_off = {};
  };

  template <class T, int D>
  class Method {
   public:
    explicit Method(const Params& params = {}) : field_((check_kick_off<Start>(), params.kick_off)) {}

    /// phi := signed distance. \throws ValueError if phi is not finite at the interface; phi is then unchanged
    template <Execution E>
    ReinitReport operator()(NarrowBand<T, D>& band, const E& execution) {
      field_.start(band, execution);
      open_.assign(field_.size() / extent, 0);
      block_open_.assign(field_.size() / Band::volume, 0);
      open_count_ = 0;
      for (const Number n : field_.known()) open_neighbours(n, std::abs(field_[n]));
      order_blocks(band);
      std::size_t sweeps = 0;
      for (; open_count_ > 0; ++sweeps) sweep(static_cast<unsigned>(sweeps % (1U << D)));
      return field_.finish(band, sweeps, execution);
    }

   private:
    using Band = NarrowBand<T, D>;
    using Number = typename detail::BlockLinks<D>::Number;
    static constexpr int extent = static_cast<int>(Band::extent);
    static constexpr int rows = static_cast<int>(Band::volume) / extent;
    static constexpr std::size_t orders = std::size_t{1} << (D - 1);
    /// Changes below this, relative to the value, are rounding.
    static constexpr T rounding = T(4) * std::numeric_limits<T>::epsilon();

    /// Blocks in ascending order along the last axis, then the one before, and so on, bit d of k turning axis d around.
    void order_blocks(const Band& band) {
      for (std::size_t k = 0; k < orders; ++k) {
        order_[k].resize(band.blocks());
        std::iota(order_[k].begin(), order_[k].end(), Number{0});
        std::sort(order_[k].begin(), order_[k].end(), [&](Number a, Number b) {
          const Index<D>& first = band.values().block_index(static_cast<std::size_t>(a));
          const Index<D>& second = band.values().block_index(static_cast<std::size_t>(b));
          for (int d = D - 1; d >= 0; --d) {
            if (first[d] != second[d]) return (first[d] < second[d]) != ((k >> d & 1U) != 0);
          }
          return false;
        });
      }
    }
    /// One sweep; bit d of `order` tells that it runs down axis d.
    void sweep(unsigned order) {
      // The order that is not stored is the reverse of the one turned around along all axes.
      const bool reverse = order >= orders;
      const auto& blocks = order_[reverse ? ((1U << D) - 1U) ^ order : order];
      for (std::size_t k = 0; k < blocks.size(); ++k) {
        const Number b = blocks[reverse ? blocks.size() - 1 - k : k];
        if (block_open_[static_cast<std::size_t>(b)] > 0) sweep_block(b, order);
      }
    }
    void sweep_block(Number b, unsigned order) {
      for (int r = 0; r < rows; ++r) {
        int row = 0;  // bits of the row's coordinates turned around
        for (int d = 1, pitch = 1; d < D; ++d, pitch *= extent) {
          const int at = r / pitch % extent;
          row += pitch * (order >> d & 1U ? extent - 1 - at : at);
        }
        const Number first = b * static_cast<Number>(Band::volume) + row * extent;
        if (open_[static_cast<std::size_t>(first / extent)] != 0) sweep_row(first, (order & 1U) != 0);
      }
    }
    /// Visits the open nodes of a row of a block, among them those that are opened on the way.
    void sweep_row(Number first, bool down) {
      const std::uint32_t& open = open_[static_cast<std::size_t>(first / extent)];
      std::uint32_t ahead = ~0U;
      while ((open & ahead) != 0) {
        const int x = down ? std::bit_width(open & ahead) - 1 : std::countr_zero(open & ahead);
        ahead = down ? (1U << x) - 1U : ~1U << x;
        visit(first + x);
      }
    }
    void visit(Number n) {
      open_[static_cast<std::size_t>(n / extent)] &= ~(1U << (n % extent));
      --block_open_[static_cast<std::size_t>(n) / Band::volume];
      --open_count_;
      const T side = field_.side(n);
      const T distance = field_.first_order(n, side);
      const T before = side * field_[n];
      if (distance >= before * (T(1) - rounding) || !(distance < field_.width())) return;
      field_.set(n, side * distance);
      open_neighbours(n, distance);
    }
    /// Opens the neighbours of a node that are further from the interface than that.
    void open_neighbours(Number from, T distance) {
      const auto neighbours = field_.around(from);
      for (int way = 0; way < 2 * D; ++way) {
        const Number n = neighbours.next(way);
        if (field_.state(n) == field_.fixed || std::abs(field_[n]) <= distance) continue;
        std::uint32_t& open = open_[static_cast<std::size_t>(n / extent)];
        const std::uint32_t bit = 1U << (n % extent);
        if ((open & bit) != 0) continue;
        open |= bit;
        ++block_open_[static_cast<std::size_t>(n) / Band::volume];
        ++open_count_;
      }
    }

    detail::DistanceField<Start, T, D> field_;
    std::array<std::vector<Number>, orders> order_;
    /// One bit for every node of a row of a block: a neighbour has changed since the node was visited last.
    std::vector<std::uint32_t> open_;
    std::vector<std::uint32_t> block_open_;
    std::size_t open_count_ = 0;
  };
};

}  // namespace cambium
