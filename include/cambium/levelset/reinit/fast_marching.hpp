// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/levelset/reinit/bucket_heap.hpp>
#include <cambium/levelset/reinit/chopp_kick_off.hpp>
#include <cambium/levelset/reinit/distance_field.hpp>

namespace cambium {

/// Reinitialisation by fast marching (Sethian 1999, "Level Set Methods and Fast Marching Methods", chapter 8): nodes
/// get their distances in ascending order, by upwind differences of order 1 or 2 from neighbours that have theirs.
///
/// Differences of second order fall back to first order where the second neighbour is not accepted yet or further from
/// the interface than the first. Only the kick-off runs on several threads: marching is serial.
template <class Start = ChoppKickOff, int Order = 2>
struct FastMarching {
  static_assert(Order == 1 || Order == 2, "cambium: marching is of first or of second order");

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
      trial_.resize(field_.size());
      sum_.resize(field_.size());
      queue_.reset(field_.width(), T(1) / T(512));
      for (const Number n : field_.known()) {
        if (next_to_open(n)) offer(n, std::abs(field_[n]));
      }
      march();
      return field_.finish(band, 1, execution);
    }

   private:
    using Number = typename detail::BlockLinks<D>::Number;
    bool next_to_open(Number n) const {
      const auto neighbours = field_.around(n);
      bool open = false;
      for (int way = 0; way < 2 * D; ++way) open |= field_.state(neighbours.next(way)) != field_.fixed;
      return open;
    }
    void march() {
      typename detail::BucketHeap<T>::Entry entry;
      // An entry counts unless its node was tried again since, or is accepted.
      const auto valid = [&](const auto& e) { return trial_[static_cast<std::size_t>(e.number)] == e.key; };
      while (queue_.pop(entry, valid)) {
        const T side = field_.side(entry.number);
        trial_[static_cast<std::size_t>(entry.number)] = T(-1);
        field_.state(entry.number) = field_.fixed;
        field_.set(entry.number, side * entry.key);
        const auto neighbours = field_.around(entry.number);
        for (int d = 0; d < D; ++d) {
          const Number down = neighbours.next(2 * d);
          const Number up = neighbours.next(2 * d + 1);
          try_node(down, d, entry.key, side, up);
          try_node(up, d, entry.key, side, down);
        }
      }
    }
    /// Tries node n, next to the node accepted last (at `first`) along `axis`. If the other neighbour along it has been
    /// accepted before, that one is nearer to the interface and nothing changes.
    void try_node(Number n, int axis, T first, T side, Number second) {
      // Bit d of its state: a neighbour along axis d is accepted. A node that is accepted itself has all bits.
      std::uint8_t& state = field_.state(n);
      if (state >> axis & 1U) return;
      detail::EikonalSum<T>& sum = sum_[static_cast<std::size_t>(n)];
      if (state == 0) sum = {first};
      state = static_cast<std::uint8_t>(state | 1U << axis);
      const T beyond = Order == 2 ? side * field_[second] : std::numeric_limits<T>::quiet_NaN();
      sum.add(detail::EikonalAxis<T>::upwind(first, beyond));
      T distance = sum.root();
      if (!(distance >= first)) distance = Order == 1 ? field_.first_order(n, side) : field_.second_order(n, side);
      offer(n, distance);
    }
    void offer(Number n, T distance) {
      trial_[static_cast<std::size_t>(n)] = distance;
      if (distance < field_.width()) queue_.push(distance, n);
    }

    detail::DistanceField<Start, T, D> field_;
    AlignedVector<T> trial_;
    AlignedVector<detail::EikonalSum<T>> sum_;
    detail::BucketHeap<T> queue_;
  };
};

}  // namespace cambium
