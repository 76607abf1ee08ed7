// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

#include <cambium/interpolation/closure.hpp>
#include <cambium/simd/pack.hpp>

namespace cambium::detail {

/// Sums that entries of lines along one axis give to the nodes around where they have gone.
///
/// Lines that lie side by side are the lanes of a vector. Neighbours nearly always move by the same whole number of
/// cells or by one more, so that with one tap more a tap is one aligned multiply-add for all lanes. The fields of a
/// node are `moved` sums of weight times value and, if `Weighed`, the sum of weights.
template <class K, class T, int Moved, bool Weighed>
class LineScatter {
 public:
  static constexpr int moved = Moved;
  static constexpr int fields = Moved + (Weighed ? 1 : 0);

  template <int D>
  LineScatter(const Lattice<D>& lattice, int axis)
      : close_(lattice, axis), last_cell_(static_cast<T>(cells_along<K>(lattice, axis) - 1)) {}

  std::ptrdiff_t count() const { return close_.nodes(); }
  bool periodic() const { return close_.periodic(); }
  /// Nodes that sums are kept for, those beyond the ends included.
  std::size_t size() const { return static_cast<std::size_t>(close_.nodes() + ends); }

  /// Gives the entries of L lines to the nodes around where they have gone.
  /// \param source displacement, strengths, carried values; entry i of the lines is at i * step
  /// \param sum    fields of size() nodes, L lanes each
  /// \return true if values are carried and displacements of neighbours differ by less than a spacing for certain
  template <std::size_t L>
  bool scatter(const std::array<const T*, moved + 1>& source, std::ptrdiff_t step, T* sum) const {
    using V = Lanes<L>;
    const std::ptrdiff_t n = close_.nodes();
    Block<L> block;
    Place place = {std::numeric_limits<T>::infinity(), 0};
    Lanes<L> before = Lanes<L>::load(source[0]), least(T(0)), most(T(0));
    for (std::ptrdiff_t i = 0; i < n; i += entries) {
      if (close_.periodic() && place.first >= n) place.first %= n;
      std::array<const T*, moved> value;
      for (std::size_t m = 0; m < moved; ++m) value[m] = source[m + 1] + i * step;
      const int count = static_cast<int>(std::min<std::ptrdiff_t>(entries, n - i));
      bool in_step = count == entries;
      for (int e = 0; e < count; ++e) {
        in_step &= weigh<L>(i + e, source, (i + e) * step, place, block.weight[e], sum) || e == 0;
        block.first[e] = place.first;
        if constexpr (Weighed) {
          const Lanes<L> here = Lanes<L>::load(source[0] + (i + e) * step);
          least = min(least, here - before);
          most = max(most, here - before);
          before = here;
        }
      }
      if (in_step) {
        add_block<L, 0>(block, value, step, sum);
      } else {
        for (int e = 0; e < count; ++e) add<L, support + 1>(block.first[e], block.weight[e], value, e * step, sum);
      }
    }
    return lowest_lane(min(least, V(T(0)) - most)) > T(-1);
  }
  /// Gives what came to nodes beyond the ends to those they stand for. \return the sums of node 0
  template <std::size_t L>
  T* close_ends(T* sum) const {
    const std::ptrdiff_t n = close_.nodes();
    const std::ptrdiff_t margin = close_.periodic() ? 0 : Taps<K>::before;
    T* node = sum + static_cast<std::size_t>(margin) * fields * L;
    const auto give = [&](std::ptrdiff_t i) {
      close_(close_.periodic() ? i % n : i, [&](std::ptrdiff_t to, double w) {
        for (std::size_t m = 0; m < fields; ++m) {
          const auto at = static_cast<std::ptrdiff_t>(m * L), size = static_cast<std::ptrdiff_t>(fields * L);
          const auto given = Lanes<L>::load_aligned(node + i * size + at);
          fma(given, Lanes<L>(static_cast<T>(w)), Lanes<L>::load_aligned(node + to * size + at))
              .store_aligned(node + to * size + at);
        }
      });
    };
    for (std::ptrdiff_t i = -margin; i < 0; ++i) give(i);
    for (std::ptrdiff_t i = n; i < n + ends - margin; ++i) give(i);
    return node;
  }

 private:
  template <std::size_t L>
  using Lanes = simd::Pack<T, L>;
  static constexpr std::size_t support = K::support;
  static constexpr int entries = 8;
  /// Nodes beyond the ends of a line that entries reach: in front of it and behind it if bounded, all behind if
  /// periodic.
  static constexpr int ends = Taps<K>::support + entries;
  /// Cell of an entry and where the sums of the first node under the kernel are.
  struct Place {
    T cell;
    std::ptrdiff_t first;
  };

  /// Entries that are given to nodes together, and their weights, each lane's moved by a tap if it is one cell further.
  template <std::size_t L>
  struct Block {
    std::ptrdiff_t first[entries];  // where the sums of the first node of each entry are
    Lanes<L> weight[entries][support + 1];
  };

  /// Place and weights of entry i. The lanes are expected in the cell after the one that the entry before was in, or
  /// one further: nodes are then known before displacements are. \return whether they are there
  template <std::size_t L>
  [[gnu::always_inline]] bool weigh(std::ptrdiff_t i, const std::array<const T*, moved + 1>& source, std::ptrdiff_t at,
                                    Place& place, Lanes<L> (&wider)[support + 1], T* sum) const {
    using V = Lanes<L>;
    V weight[support];
    const V cell = locate<L>(i, source[0] + at, weight);
    place.cell += T(1);
    ++place.first;
    V further = cell - V(place.cell);
    const bool expected = all_equal(further, further * further);  // 0 or 1
    if (!expected) {
      place = find(lowest_lane(cell));
      further = cell - V(place.cell);
      if (!all_equal(further, further * further)) {
        add_each_cell<L>(i, source, at, sum);
        for (V& w : wider) w = V(T(0));
        return false;
      }
    }
    wider[0] = where_equal(further, V(T(0)), weight[0], V(T(0)));
    for (std::size_t k = 1; k < support; ++k) wider[k] = where_equal(further, V(T(0)), weight[k], weight[k - 1]);
    wider[support] = where_equal(further, V(T(0)), V(T(0)), weight[support - 1]);
    return expected;
  }
  Place find(T cell) const {
    const auto node = static_cast<std::ptrdiff_t>(cell) - Taps<K>::before;
    const std::ptrdiff_t n = close_.nodes();
    return {cell, close_.periodic() ? (node % n + n) % n : node + Taps<K>::before};
  }
  /// The general case: one cell after another, with the weights of lanes in other cells set to zero.
  template <std::size_t L>
  [[gnu::noinline]] void add_each_cell(std::ptrdiff_t i, const std::array<const T*, moved + 1>& source,
                                       std::ptrdiff_t at, T* sum) const {
    std::array<const T*, moved> value;
    std::copy_n(source.begin() + 1, moved, value.begin());
    Lanes<L> weight[support];
    const Lanes<L> cell = locate<L>(i, source[0] + at, weight);
    alignas(64) T cells[L];
    cell.store_aligned(cells);
    std::sort(cells, cells + L);
    const T* end = std::unique(cells, cells + L);
    for (const T* c = cells; c < end; ++c) {
      Lanes<L> masked[support];
      for (std::size_t k = 0; k < support; ++k) masked[k] = where_equal(cell, Lanes<L>(*c), weight[k], Lanes<L>(T(0)));
      add<L, support>(find(*c).first, masked, value, at, sum);
    }
  }
  /// Cells of entry i of L lines, and the weights of the nodes under the kernel.
  template <std::size_t L>
  [[gnu::always_inline]] Lanes<L> locate(std::ptrdiff_t i, const T* displacement, Lanes<L> (&weight)[support]) const {
    using V = Lanes<L>;
    const V u = V::load(displacement) + V(static_cast<T>(i) + static_cast<T>(Taps<K>::shift));
    V cell = floor(u);
    if (!close_.periodic()) cell = max(min(cell, V(last_cell_)), V(T(0)));
    weights<L>(u - cell - V(T(0.5)), weight);
    return cell;
  }
  /// True if taps k and support - 1 - k have the same even powers of g and opposite odd ones, up to round-off.
  static constexpr bool mirrored = [] {
    for (int j = 0; j <= Taps<K>::degree; ++j) {
      for (std::size_t k = 0; k < support; ++k) {
        const double here = Taps<K>::coefficients.value[j][k];
        const double there = Taps<K>::coefficients.value[j][support - 1 - k] * (j % 2 == 0 ? 1.0 : -1.0);
        if (here - there > 1e-14 || there - here > 1e-14) return false;
      }
    }
    return true;
  }();
  /// Weights of all taps at g.
  template <std::size_t L>
  static void weights(const Lanes<L>& g, Lanes<L> (&weight)[support]) {
    using V = Lanes<L>;
    if constexpr (Taps<K>::polynomial) {
      constexpr int last = Taps<K>::degree;
      const V square = g * g, minus = V(T(0)) - g;
      const auto powers = [&](int highest, std::size_t k) {  // highest, highest - 2, ...
        V sum(static_cast<T>(Taps<K>::coefficients.value[highest][k]));
        for (int j = highest - 2; j >= 0; j -= 2) {
          sum = fma(sum, square, V(static_cast<T>(Taps<K>::coefficients.value[j][k])));
        }
        return sum;
      };
      for (std::size_t k = 0; k < (mirrored ? (support + 1) / 2 : support); ++k) {
        const V even = powers(last - last % 2, k);
        const V odd = last > 0 ? powers(last - 1 + last % 2, k) : V(T(0));
        weight[k] = fma(odd, g, even);
        if (mirrored) weight[support - 1 - k] = fma(odd, minus, even);
      }
    } else {
      alignas(64) T offset[L], lane[support], all[support][L];
      g.store_aligned(offset);
      for (std::size_t l = 0; l < L; ++l) {
        Taps<K>::weights(offset[l], lane);
        for (std::size_t k = 0; k < support; ++k) all[k][l] = lane[k];
      }
      for (std::size_t k = 0; k < support; ++k) weight[k] = Lanes<L>::load(all[k]);
    }
  }
  /// Adds one entry to the nodes from `first` on.
  template <std::size_t L, std::size_t Count>
  static void add(std::ptrdiff_t first, const Lanes<L> (&weight)[Count], const std::array<const T*, moved>& value,
                  std::ptrdiff_t at, T* sum) {
    using V = Lanes<L>;
    T* node = sum + static_cast<std::size_t>(first) * fields * L;
    for (std::size_t k = 0; k < Count; ++k, node += fields * L) {
      for (std::size_t m = 0; m < moved; ++m) {
        fma(weight[k], V::load(value[m] + at), V::load_aligned(node + m * L)).store_aligned(node + m * L);
      }
      if constexpr (Weighed) (weight[k] + V::load_aligned(node + moved * L)).store_aligned(node + moved * L);
    }
  }
  /// Adds a block of entries that follow one another, field M and the ones after it: each sum is read and written once.
  template <std::size_t L, std::size_t M>
  static void add_block(const Block<L>& block, const std::array<const T*, moved>& value, std::ptrdiff_t step, T* sum) {
    using V = Lanes<L>;
    T* const node = sum + static_cast<std::size_t>(block.first[0]) * fields * L + M * L;
    V entry[entries];
    for (int e = 0; e < entries; ++e) entry[e] = M < moved ? V::load(value[M < moved ? M : 0] + e * step) : V(T(1));
    const auto gather = [&]<std::size_t J>(std::integral_constant<std::size_t, J>) {
      constexpr int lowest = J > support ? static_cast<int>(J - support) : 0;
      constexpr int highest = J < entries ? static_cast<int>(J) : entries - 1;
      V total = V::load_aligned(node + J * fields * L);
      for (int e = lowest; e <= highest; ++e) {
        const V& weight = block.weight[e][static_cast<int>(J) - e];
        total = M < moved ? fma(weight, entry[e], total) : weight + total;
      }
      total.store_aligned(node + J * fields * L);
    };
    [&]<std::size_t... J>(std::index_sequence<J...>) { (gather(std::integral_constant<std::size_t, J>{}), ...); }
    (std::make_index_sequence<entries + support>{});
    if constexpr (M + 1 < fields) add_block<L, M + 1>(block, value, step, sum);
  }

  Closure<K> close_;
  T last_cell_;
};

}  // namespace cambium::detail
