// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include <cambium/levelset/reinit/chopp_kick_off.hpp>
#include <cambium/levelset/reinit/distance_field.hpp>

namespace cambium {

/// Reinitialisation by group marching (Kim 2001, "An O(N) level set method for eikonal equations"): of the nodes of the
/// front all those advance at once that are less than 1 / sqrt(D) spacings behind the foremost, whose distances hardly
/// depend on each other; two passes over their neighbours, backward and forward, see to what dependence there is. First
/// order, no sorting. Only the kick-off runs on several threads.
template <class Start = ChoppKickOff>
struct GroupMarching {
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
      front_.clear();
      for (const Number n : field_.known()) update_neighbours(n, true);
      T limit = field_.width();
      for (const Number n : front_) limit = std::min(limit, std::abs(field_[n]));
      std::size_t groups = 0;
      for (; !front_.empty(); ++groups) advance(limit += group_width);
      return field_.finish(band, groups, execution);
    }

   private:
    using Number = typename detail::BlockLinks<D>::Number;
    /// State of a node; one that is neither is far from the front.
    static constexpr std::uint8_t trial = 1;
    static constexpr std::uint8_t done = detail::DistanceField<Start, T, D>::fixed;
    static constexpr T group_width = static_cast<T>(D == 2 ? 1.0 / std::numbers::sqrt2 : std::numbers::inv_sqrt3);

    /// Takes all nodes up to `limit` out of the front, and their neighbours in.
    void advance(T limit) {
      const std::size_t size = front_.size();
      for (std::size_t k = size; k-- > 0;) {
        if (std::abs(field_[front_[k]]) <= limit) update_neighbours(front_[k], false);
      }
      std::size_t kept = 0;
      for (std::size_t k = 0; k < size; ++k) {
        const Number n = front_[k];
        if (std::abs(field_[n]) <= limit) {
          update_neighbours(n, true);
          field_.state(n) = done;
        } else {
          front_[kept++] = n;
        }
      }
      front_.erase(front_.begin() + static_cast<std::ptrdiff_t>(kept),
                   front_.begin() + static_cast<std::ptrdiff_t>(size));
    }
    void update_neighbours(Number from, bool enlist) {
      const auto neighbours = field_.around(from);
      const T side = field_.side(from);
      for (int way = 0; way < 2 * D; ++way) {
        const Number n = neighbours.next(way);
        std::uint8_t& state = field_.state(n);
        if (state == done) continue;
        const T distance = field_.first_order(n, side);
        if (!(distance < field_.width())) continue;
        if (!(side * field_[n] <= distance)) field_.set(n, side * distance);
        if (enlist && state != trial) {
          state = trial;
          front_.push_back(n);
        }
      }
    }

    detail::DistanceField<Start, T, D> field_;
    std::vector<Number> front_;
  };
};

}  // namespace cambium
