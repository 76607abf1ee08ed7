// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include <cambium/interpolation/closure.hpp>
#include <cambium/simd/pack.hpp>
#include <cambium/simd/transpose.hpp>

namespace cambium::detail {

/// Layout of `lines` lines of equal length side by side: entry i of line l is at i * along + l * across. One of the
/// strides is 1.
struct LineTile {
  std::ptrdiff_t lines;
  std::ptrdiff_t along;
  std::ptrdiff_t across;
};

/// One pass of a split remeshing: moves strengths along lines of one axis by a displacement and remeshes each line.
///
/// Passes follow one another along different axes. A pass carries the displacements along the axes still to come with
/// it, as values (renormalised by the sum of the weights), so that the passes compose to the whole displacement: there
/// is no splitting error that an ordering after Strang would have to cancel. Every line must stay ordered, i.e. the
/// displacement may shear but not fold: 1 + d(displacement)/dx > 0 along each axis in turn, as under a Lagrangian CFL
/// number below 1.
///
/// Lines that lie side by side are the lanes of a vector. Neighbours nearly always move by the same whole number of
/// cells or by one more, so that with one tap more a tap is one aligned multiply-add for all lanes.
template <class K, class T, int Strengths, int Carried>
class SplitPass {
 public:
  static constexpr int moved = Strengths + Carried;
  static constexpr int fields = moved + (Carried > 0 ? 1 : 0);
  static constexpr std::size_t support = K::support;
  static constexpr std::size_t wide = simd::native_lanes<T>;
  static constexpr int entries = 8;
  /// A node that gets less than this sum of weights has lost its particles.
  static constexpr T smallest_weight = T(0.1);

  template <int D>
  SplitPass(const Lattice<D>& lattice, int axis)
      : close_(lattice, axis), axis_(axis), last_cell_(static_cast<T>(cells_along<K>(lattice, axis) - 1)) {}

  /// Values of scratch that a call needs.
  std::size_t scratch_size() const {
    const auto n = static_cast<std::size_t>(close_.nodes());
    return ((n + ends) * fields + n * (moved + 1)) * wide;
  }

  /// \param displacement along the axis, in spacings, laid out as `from` says
  /// \param in           strengths, then displacements to carry, laid out as `from` says
  /// \param out          the same after the move, laid out as `to` says; must not overlap the input
  /// \param scratch      aligned, of scratch_size()
  /// \throws ValueError if carried displacements reach a node with a sum of weights below smallest_weight
  void operator()(const LineTile& from, const T* displacement, const std::array<const T*, moved>& in,
                  const LineTile& to, const std::array<T*, moved>& out, T* scratch) const {
    const auto lanes = static_cast<std::ptrdiff_t>(wide);
    if (std::min(from.lines, close_.nodes()) < lanes) {
      for (std::ptrdiff_t l = 0; l < from.lines; ++l) move<1>(l, from, displacement, in, to, out, scratch);
      return;
    }
    for (std::ptrdiff_t l = 0; l < from.lines; l += lanes) {
      // The last group is moved back to be full: some lines are done twice, alike.
      move<wide>(std::min(l, from.lines - lanes), from, displacement, in, to, out, scratch);
    }
  }

 private:
  template <std::size_t L>
  using Lanes = simd::Pack<T, L>;
  /// Nodes beyond the ends of a line that entries reach: in front of it and behind it if bounded, all behind if
  /// periodic.
  static constexpr int ends = Taps<K>::support + entries;
  /// Cell of an entry and where the sums of the first node under the kernel are.
  struct Place {
    T cell;
    std::ptrdiff_t first;
  };

  /// Moves L lines from line l on.
  template <std::size_t L>
  void move(std::ptrdiff_t l, const LineTile& from, const T* displacement, const std::array<const T*, moved>& in,
            const LineTile& to, const std::array<T*, moved>& out, T* scratch) const {
    const std::ptrdiff_t n = close_.nodes();
    T* sum = scratch;
    const std::size_t sums = static_cast<std::size_t>(n + ends) * fields * L;
    T* line = scratch + sums;
    std::fill_n(sum, sums, T(0));
    std::array<const T*, moved + 1> source;
    source[0] = displacement + l * from.across;
    for (std::size_t m = 0; m < moved; ++m) source[m + 1] = in[m] + l * from.across;
    std::ptrdiff_t step = from.along;
    if (L > 1 && from.across != 1) {
      for (std::size_t m = 0; m <= moved; ++m, line += static_cast<std::size_t>(n) * L) {
        interleave<L>(source[m], from.across, line);
        source[m] = line;
      }
      step = static_cast<std::ptrdiff_t>(L);
    }
    scatter<L>(source, step, sum);
    sum = close_ends<L>(sum);
    write<L>(sum, to, l, out);
  }
  /// Values can be carried only if no particle of a line has passed the next: 1 + d(displacement)/dx > 0. On periodic
  /// axes displacements are known up to a period.
  template <std::size_t L>
  [[gnu::noinline]] void require_order(const T* displacement, std::ptrdiff_t step) const {
    const std::ptrdiff_t n = close_.nodes();
    const Lanes<L> period(close_.periodic() ? static_cast<T>(n) : T(0));
    const Lanes<L> per_period(close_.periodic() ? T(1) / static_cast<T>(n) : T(0));
    Lanes<L> steepest(T(0));
    Lanes<L> here = Lanes<L>::load(displacement);
    for (std::ptrdiff_t i = 1; i < n; ++i) {
      const Lanes<L> next = Lanes<L>::load(displacement + i * step);
      const Lanes<L> change = next - here;
      steepest = min(steepest, change - period * floor(fma(change, per_period, Lanes<L>(T(0.5)))));
      here = next;
    }
    const T change = lowest_lane(steepest);
    if (change > T(-1)) return;
    throw ValueError(message("split remeshing along axis ", axis_, " meets displacements of neighbours that differ by ",
                             change,
                             " spacings, so that one has passed the other: remesh after a shorter step, or use the "
                             "strategy Tensor"));
  }
  /// L rows of contiguous entries -> entries of all L rows side by side.
  template <std::size_t L>
  void interleave(const T* row, std::ptrdiff_t across, T* line) const {
    const auto lanes = static_cast<std::ptrdiff_t>(L);
    for_each_block<L>([&](std::ptrdiff_t i) { simd::transpose<L>(row + i, across, line + i * lanes, lanes); });
  }
  /// Calls f(i) for blocks of L entries from i on that cover a line; the last is moved back to be full.
  template <std::size_t L, class F>
  void for_each_block(F&& f) const {
    const auto lanes = static_cast<std::ptrdiff_t>(L);
    for (std::ptrdiff_t i = 0; i < close_.nodes(); i += lanes) f(std::min(i, close_.nodes() - lanes));
  }
  /// Writes L lines from line l on, a block of nodes after the other, renormalised.
  template <std::size_t L>
  void write(T* sum, const LineTile& to, std::ptrdiff_t l, const std::array<T*, moved>& out) const {
    constexpr auto pitch = static_cast<std::ptrdiff_t>(fields * L), lanes = static_cast<std::ptrdiff_t>(L);
    Lanes<L> lowest(T(1));
    for (std::ptrdiff_t i = 0; i < close_.nodes(); i += lanes) {
      const std::ptrdiff_t end = std::min(i + lanes, close_.nodes());
      if constexpr (Carried > 0) {
        for (std::ptrdiff_t j = i; j < end; ++j) lowest = min(lowest, renormalise<L>(sum + j * pitch));
      }
      for (std::ptrdiff_t m = 0; m < moved; ++m) {
        T* line = out[m] + l * to.across;
        if (L > 1 && to.across != 1) {
          const std::ptrdiff_t first = end - lanes;
          simd::transpose<L>(sum + first * pitch + m * lanes, pitch, line + first, to.across);
        } else {
          for (std::ptrdiff_t j = i; j < end; ++j) {
            Lanes<L>::load_aligned(sum + j * pitch + m * lanes).store(line + j * to.along);
          }
        }
      }
    }
    if constexpr (Carried > 0) require_weight(lowest_lane(lowest));
  }
  /// Entries that are given to nodes together, and their weights, each lane's moved by a tap if it is one cell further.
  template <std::size_t L>
  struct Block {
    std::ptrdiff_t first[entries];  // where the sums of the first node of each entry are
    Lanes<L> weight[entries][support + 1];
  };

  /// Gives the entries of L lines to the nodes around where they have gone.
  template <std::size_t L>
  void scatter(const std::array<const T*, moved + 1>& source, std::ptrdiff_t step, T* sum) const {
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
        if constexpr (Carried > 0) {
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
    if constexpr (Carried > 0) {
      if (!(lowest_lane(min(least, V(T(0)) - most)) > T(-1))) require_order<L>(source[0], step);
    }
  }
  /// Place and weights of entry i. The lanes are expected in the cell after the one that the entry before was in, or
  /// one further: nodes are then known before displacements are. \return whether they are there
  template <std::size_t L>
  [[gnu::always_inline]] bool weigh(std::ptrdiff_t i, const std::array<const T*, moved + 1>& source, std::ptrdiff_t at,
                                    Place& place, Lanes<L> (&wider)[support + 1], T* sum) const {
    using V = Lanes<L>;
    const V u = V::load(source[0] + at) + V(static_cast<T>(i) + static_cast<T>(Taps<K>::shift));
    V cell = floor(u);
    if (!close_.periodic()) cell = max(min(cell, V(last_cell_)), V(T(0)));
    V weight[support];
    weights<L>(u - cell - V(T(0.5)), weight);
    place.cell += T(1);
    ++place.first;
    V further = cell - V(place.cell);
    const bool expected = all_equal(further, further * further);  // 0 or 1
    if (!expected) {
      place = find(lowest_lane(cell));
      further = cell - V(place.cell);
      if (!all_equal(further, further * further)) {
        add_each_cell<L>(cell, weight, source, at, sum);
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
  [[gnu::noinline]] void add_each_cell(const Lanes<L>& cell, const Lanes<L> (&weight)[support],
                                       const std::array<const T*, moved + 1>& source, std::ptrdiff_t at, T* sum) const {
    std::array<const T*, moved> value;
    std::copy_n(source.begin() + 1, moved, value.begin());
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
  /// Weights of all taps at g. Those of taps k and support - 1 - k have the same even powers of g and opposite odd
  /// ones.
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
      for (std::size_t k = 0; k < (support + 1) / 2; ++k) {
        const V even = powers(last - last % 2, k);
        const V odd = last > 0 ? powers(last - 1 + last % 2, k) : V(T(0));
        weight[k] = fma(odd, g, even);
        weight[support - 1 - k] = fma(odd, minus, even);
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
      if constexpr (Carried > 0) (weight[k] + V::load_aligned(node + moved * L)).store_aligned(node + moved * L);
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
  /// Carried values of a node := sums / sum of weights, which is returned.
  template <std::size_t L>
  static Lanes<L> renormalise(T* at) {
    const Lanes<L> weight = Lanes<L>::load_aligned(at + moved * L);
    const Lanes<L> inverse = Lanes<L>(T(1)) / weight;
    for (std::size_t m = Strengths; m < moved; ++m) {
      (Lanes<L>::load_aligned(at + m * L) * inverse).store_aligned(at + m * L);
    }
    return weight;
  }
  void require_weight(T worst) const {
    if (worst >= smallest_weight) return;
    throw ValueError(message("split remeshing along axis ", axis_, " leaves a node with a sum of weights of ", worst,
                             " (1 for particles at rest): the particles have moved too far apart or past each other; "
                             "remesh after a shorter step, or use the strategy Tensor"));
  }

  Closure<K> close_;
  int axis_;
  T last_cell_;
};

}  // namespace cambium::detail
