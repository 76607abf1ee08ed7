// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <cambium/interpolation/closure.hpp>

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
  /// A node that gets less than this sum of weights has lost its particles.
  static constexpr T smallest_weight = T(0.1);

  template <int D>
  SplitPass(const Lattice<D>& lattice, int axis)
      : close_(lattice, axis), axis_(axis), last_cell_(static_cast<T>(cells_along<K>(lattice, axis) - 1)) {}

  /// Values of scratch that a call needs.
  std::size_t scratch_size() const {
    return static_cast<std::size_t>(close_.nodes()) * static_cast<std::size_t>(fields + moved + 1) * wide;
  }

  /// \param displacement along the axis, in spacings, laid out as `from` says
  /// \param in           strengths, then displacements to carry, laid out as `from` says
  /// \param out          the same after the move, laid out as `to` says; must not overlap the input
  /// \param scratch      aligned, of scratch_size()
  /// \throws ValueError if carried displacements reach a node with a sum of weights below smallest_weight
  void operator()(const LineTile& from, const T* displacement, const std::array<const T*, moved>& in,
                  const LineTile& to, const std::array<T*, moved>& out, T* scratch) const {
    const auto lanes = static_cast<std::ptrdiff_t>(wide);
    if (from.lines < lanes) {
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

  /// Moves L lines from line l on.
  template <std::size_t L>
  void move(std::ptrdiff_t l, const LineTile& from, const T* displacement, const std::array<const T*, moved>& in,
            const LineTile& to, const std::array<T*, moved>& out, T* scratch) const {
    const std::ptrdiff_t n = close_.nodes();
    T* sum = scratch;
    T* line = scratch + static_cast<std::size_t>(n) * fields * L;
    std::fill_n(sum, static_cast<std::size_t>(n) * fields * L, T(0));
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
    if constexpr (Carried > 0) require_order<L>(source[0], step);
    for (std::ptrdiff_t i = 0; i < n; ++i) scatter<L>(i, source, i * step, sum);
    if constexpr (Carried > 0) renormalise<L>(sum);
    for (std::size_t m = 0; m < moved; ++m) write<L>(sum + m * L, to, out[m] + l * to.across);
  }
  /// Values can be carried only if no particle of a line has passed the next: 1 + d(displacement)/dx > 0. On periodic
  /// axes displacements are known up to a period.
  template <std::size_t L>
  void require_order(const T* displacement, std::ptrdiff_t step) const {
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
    for (std::size_t l = 0; l < L; ++l, row += across) {
      for (std::ptrdiff_t i = 0; i < close_.nodes(); ++i) line[static_cast<std::size_t>(i) * L + l] = row[i];
    }
  }
  template <std::size_t L>
  void write(const T* sum, const LineTile& to, T* out) const {
    const auto n = static_cast<std::size_t>(close_.nodes());
    if (L > 1 && to.across != 1) {
      for (std::size_t l = 0; l < L; ++l, out += to.across) {
        for (std::size_t i = 0; i < n; ++i) out[i] = sum[i * fields * L + l];
      }
    } else {
      for (std::size_t i = 0; i < n; ++i, out += to.along) Lanes<L>::load_aligned(sum + i * fields * L).store(out);
    }
  }

  /// Gives entry i of L lines to the nodes around where it has gone.
  template <std::size_t L>
  void scatter(std::ptrdiff_t i, const std::array<const T*, moved + 1>& source, std::ptrdiff_t at, T* sum) const {
    using V = Lanes<L>;
    const V u = V::load(source[0] + at) + V(static_cast<T>(i) + static_cast<T>(Taps<K>::shift));
    V cell = floor(u);
    if (!close_.periodic()) cell = max(min(cell, V(last_cell_)), V(T(0)));
    V value[fields];
    for (std::size_t m = 0; m < moved; ++m) value[m] = V::load(source[m + 1] + at);
    if constexpr (Carried > 0) value[moved] = V(T(1));
    V weight[support];
    weigh<L>(u - cell - V(T(0.5)), weight);
    const T lowest = lowest_lane(cell);
    const auto node = static_cast<std::ptrdiff_t>(lowest) - Taps<K>::before;
    if (all_equal(cell, V(lowest))) {
      add<L, support>(node, weight, value, sum);
    } else if (all_equal(max(cell, V(lowest + T(1))), V(lowest + T(1)))) {
      V wider[support + 1];  // weights of the lanes that are one cell further, moved by one tap
      wider[0] = where_equal(cell, V(lowest), weight[0], V(T(0)));
      for (std::size_t k = 1; k < support; ++k) wider[k] = where_equal(cell, V(lowest), weight[k], weight[k - 1]);
      wider[support] = where_equal(cell, V(lowest), V(T(0)), weight[support - 1]);
      add<L, support + 1>(node, wider, value, sum);
    } else {
      add_each_cell<L>(cell, weight, value, sum);
    }
  }
  /// The general case: one cell after another, with the weights of lanes in other cells set to zero.
  template <std::size_t L>
  void add_each_cell(const Lanes<L>& cell, const Lanes<L> (&weight)[support], const Lanes<L> (&value)[fields],
                     T* sum) const {
    alignas(64) T cells[L];
    cell.store_aligned(cells);
    std::sort(cells, cells + L);
    const T* end = std::unique(cells, cells + L);
    for (const T* c = cells; c < end; ++c) {
      Lanes<L> masked[support];
      for (std::size_t k = 0; k < support; ++k) masked[k] = where_equal(cell, Lanes<L>(*c), weight[k], Lanes<L>(T(0)));
      add<L, support>(static_cast<std::ptrdiff_t>(*c) - Taps<K>::before, masked, value, sum);
    }
  }
  template <std::size_t L>
  static void weigh(const Lanes<L>& g, Lanes<L> (&weight)[support]) {
    if constexpr (Taps<K>::polynomial) {
      for (std::size_t k = 0; k < support; ++k) {
        Lanes<L> w(static_cast<T>(Taps<K>::coefficients.value[Taps<K>::degree][k]));
        for (int j = Taps<K>::degree - 1; j >= 0; --j) {
          w = fma(w, g, Lanes<L>(static_cast<T>(Taps<K>::coefficients.value[j][k])));
        }
        weight[k] = w;
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
  template <std::size_t L, std::size_t Count>
  void add(std::ptrdiff_t node, const Lanes<L> (&weight)[Count], const Lanes<L> (&value)[fields], T* sum) const {
    const std::ptrdiff_t n = close_.nodes();
    if (node >= 0 && node + static_cast<std::ptrdiff_t>(Count) <= n) {
      T* at = sum + static_cast<std::size_t>(node) * fields * L;
      for (std::size_t k = 0; k < Count; ++k, at += fields * L) add_to<L>(at, weight[k], value);
      return;
    }
    for (std::size_t k = 0; k < Count; ++k) {
      std::ptrdiff_t i = node + static_cast<std::ptrdiff_t>(k);
      if (close_.periodic()) i = (i % n + n) % n;
      close_(i, [&](std::ptrdiff_t to, double w) {
        add_to<L>(sum + static_cast<std::size_t>(to) * fields * L, weight[k] * Lanes<L>(static_cast<T>(w)), value);
      });
    }
  }
  template <std::size_t L>
  static void add_to(T* at, const Lanes<L>& weight, const Lanes<L> (&value)[fields]) {
    for (std::size_t m = 0; m < moved; ++m) {
      fma(weight, value[m], Lanes<L>::load_aligned(at + m * L)).store_aligned(at + m * L);
    }
    if constexpr (Carried > 0) (weight + Lanes<L>::load_aligned(at + moved * L)).store_aligned(at + moved * L);
  }
  /// Carried values := sums / sum of weights.
  template <std::size_t L>
  void renormalise(T* sum) const {
    Lanes<L> lowest(T(1));
    T* at = sum;
    for (std::ptrdiff_t i = 0; i < close_.nodes(); ++i, at += fields * L) {
      const Lanes<L> weight = Lanes<L>::load_aligned(at + moved * L);
      lowest = min(lowest, weight);
      const Lanes<L> inverse = Lanes<L>(T(1)) / weight;
      for (std::size_t m = Strengths; m < moved; ++m) {
        (Lanes<L>::load_aligned(at + m * L) * inverse).store_aligned(at + m * L);
      }
    }
    const T worst = lowest_lane(lowest);
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
