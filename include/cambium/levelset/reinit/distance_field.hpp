// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <cambium/core/aligned.hpp>
#include <cambium/levelset/reinit/block_links.hpp>
#include <cambium/levelset/reinit/eikonal_update.hpp>
#include <cambium/levelset/reinit/kick_off.hpp>
#include <cambium/levelset/reinitialisation.hpp>

namespace cambium::detail {

/// Signed distances, in spacings, of the nodes of a band while they are being found, by the number of the node. A node
/// whose distance is not known yet has a NaN with the sign of its side.
///
/// Nodes next to the interface have theirs from the kick-off. So a node that does not has all its neighbours on its own
/// side; of the second neighbours, those across the interface continue the distance with the other sign.
template <class KickOff, class T, int D>
class DistanceField {
 public:
  using Band = NarrowBand<T, D>;
  using Number = typename BlockLinks<D>::Number;
  static constexpr int ways = BlockLinks<D>::ways;

  explicit DistanceField(const typename KickOff::Params& params) : kick_off_(params) {}

  /// Distances of the nodes next to the interface of `band`. \throws ValueError if phi is not finite there
  template <Execution E>
  void start(const Band& band, const E& execution) {
    width_ = static_cast<T>(static_cast<double>(band.half_width()) / band.spacing());
    links_.build(band);
    distance_.resize(links_.size());
    state_.resize(links_.size());
    std::fill(distance_.begin() + links_.end(), distance_.end(), unknown);
    std::fill(state_.begin() + links_.end(), state_.end(), fixed);
    for_each_piece(execution, band.blocks(), 1, [&](std::size_t b, std::size_t) { start_block(band, b); });
    counts_ = kick_off_(band, std::span<T>(distance_.data(), static_cast<std::size_t>(links_.end())), execution);
    list_known(band);
  }
  /// phi := distance within the half width, +-half width elsewhere.
  template <Execution E>
  ReinitReport finish(Band& band, std::size_t iterations, const E& execution) {
    in_band_.assign(band.blocks(), 0);
    for_each_piece(execution, band.blocks(), 1, [&](std::size_t b, std::size_t) {
      const auto phi = band.values().block(b);
      const T* distance = distance_.data() + b * Band::volume;
      const T h = static_cast<T>(band.spacing());
      const T far = band.half_width();
      std::size_t count = 0;
      for (std::size_t i = 0; i < phi.size(); ++i) {
        const T value = distance[i] * h;
        const bool inside = std::abs(value) < far;  // false for NaN
        phi[i] = inside ? keep_side(value, phi[i]) : (phi[i] < T(0) ? -far : far);
        count += inside;
      }
      in_band_[b] = count;
    });
    ReinitReport report{0, counts_.lower_order, counts_.estimated, iterations};
    for (const std::size_t count : in_band_) report.nodes += count;
    return report;
  }

  /// Half width in spacings.
  T width() const { return width_; }
  /// Numbers below end() are nodes of blocks; those below size() may come out of next().
  Number end() const { return links_.end(); }
  std::size_t size() const { return links_.size(); }
  typename BlockLinks<D>::Around around(Number n) const { return links_.around(n); }
  /// Numbers of the nodes that the kick-off gave distances to, ascending.
  const std::vector<Number>& known() const { return known_; }
  /// State of a node, for marching and sweeping to use as they like: 0 at first, and `fixed` at the nodes next to the
  /// interface and at what is no node of the lattice or of no block.
  std::uint8_t state(Number n) const { return state_[static_cast<std::size_t>(n)]; }
  std::uint8_t& state(Number n) { return state_[static_cast<std::size_t>(n)]; }
  static constexpr std::uint8_t fixed = 0xff;

  T operator[](Number n) const { return distance_[static_cast<std::size_t>(n)]; }
  /// -1 or 1, the side of a node.
  T side(Number n) const { return std::copysign(T(1), (*this)[n]); }
  void set(Number n, T signed_distance) { distance_[static_cast<std::size_t>(n)] = signed_distance; }

  /// Distance, without sign, of node n from those of its neighbours that are known, by the scheme of first order.
  T first_order(Number n, T side) const {
    std::array<T, D> first;
    const auto neighbours = around(n);
    for (int d = 0; d < D; ++d) {
      const T low = known_or_infinite(side * (*this)[neighbours.next(2 * d)]);
      const T high = known_or_infinite(side * (*this)[neighbours.next(2 * d + 1)]);
      first[d] = std::min(low, high);
    }
    return solve_eikonal_first_order(first);
  }
  /// The same by the scheme of second order, which falls back to first order along an axis where the second neighbour
  /// is not known or further from the interface than the first.
  T second_order(Number n, T side) const {
    std::array<EikonalAxis<T>, D> axes;
    const auto neighbours = around(n);
    for (int d = 0; d < D; ++d) {
      const Number down = neighbours.next(2 * d);
      const Number up = neighbours.next(2 * d + 1);
      const T low = known_or_infinite(side * (*this)[down]);
      const T high = known_or_infinite(side * (*this)[up]);
      const bool take_up = high < low;
      const T second = side * (*this)[around(take_up ? up : down).next(2 * d + take_up)];
      axes[d] = EikonalAxis<T>::upwind(take_up ? high : low, second);
    }
    return solve_eikonal(axes);
  }

 private:
  static constexpr T unknown = std::numeric_limits<T>::quiet_NaN();

  static T known_or_infinite(T value) { return value == value ? value : std::numeric_limits<T>::infinity(); }
  static T keep_side(T value, T phi) { return value == T(0) && phi < T(0) ? -std::numeric_limits<T>::min() : value; }

  void start_block(const Band& band, std::size_t b) {
    const auto phi = band.values().block(b);
    T* distance = distance_.data() + b * Band::volume;
    for (std::size_t i = 0; i < Band::volume; ++i) distance[i] = phi[i] < T(0) ? -unknown : unknown;
    std::fill_n(state_.data() + b * Band::volume, Band::volume, std::uint8_t{0});
    std::size_t pitch = 1;
    for (int d = 0; d < D; ++d, pitch *= Band::extent) {
      const std::ptrdiff_t size = band.lattice().nodes()[d] - band.values().block_origin(b)[d];
      if (size >= Band::extent) continue;
      for (std::size_t i = 0; i < Band::volume; ++i) {
        if (static_cast<std::ptrdiff_t>(i / pitch % Band::extent) >= size) state_[b * Band::volume + i] = fixed;
      }
    }
  }
  [[noreturn]] static void throw_not_finite(const Band& band, std::size_t b, std::size_t i) {
    throw ValueError(message("phi is ", band.values().block(b)[i], " at node ", band.values().node(b, i),
                             ": it must be finite at and around the interface"));
  }
  void list_known(const Band& band) {
    known_.clear();
    for (std::size_t n = 0; n < static_cast<std::size_t>(links_.end()); ++n) {
      if (!(distance_[n] == distance_[n])) continue;
      if (!std::isfinite(band.values().block(n / Band::volume)[n % Band::volume])) {
        throw_not_finite(band, n / Band::volume, n % Band::volume);
      }
      known_.push_back(static_cast<Number>(n));
      state_[n] = fixed;
    }
  }

  typename KickOff::template Method<T, D> kick_off_;
  KickOffCounts counts_;
  T width_{};
  BlockLinks<D> links_;
  AlignedVector<T> distance_;
  std::vector<std::uint8_t> state_;
  std::vector<Number> known_;
  std::vector<std::size_t> in_band_;
};

}  // namespace cambium::detail
