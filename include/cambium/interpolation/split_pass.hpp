// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <cambium/interpolation/closure.hpp>
#include <cambium/parallel/execution.hpp>

namespace cambium::detail {

/// One pass of a split remeshing: moves strengths along lines of one axis by a displacement and remeshes each line.
///
/// Passes follow one another along the last, ..., first axis. A pass carries the displacements along the axes still to
/// come with it, as values (renormalised by the sum of the weights), so that the passes compose to the whole
/// displacement: there is no splitting error that an ordering after Strang would have to cancel, and the order of
/// accuracy is that of the kernel. Every line must stay ordered, i.e. the displacement may shear but not fold:
/// 1 + d(displacement)/dx > 0 along each axis in turn, as under a Lagrangian CFL number below 1.
///
/// Lines that lie side by side are the lanes of a vector. Neighbours nearly always move by the same whole number of
/// cells, so that a tap is one aligned multiply-add for all lanes; where they differ, lanes are masked.
template <class K, class T, int Strengths, int Carried>
class SplitPass {
 public:
  static constexpr int fields = Strengths + Carried + (Carried > 0 ? 1 : 0);
  static constexpr std::size_t support = K::support;

  /// `lines` lines of `nodes` entries: entry i of line l is at offset l_offset + i * stride.
  struct Shape {
    std::ptrdiff_t nodes;
    std::ptrdiff_t stride;
    std::ptrdiff_t lane_stride;
  };

  template <int D>
  SplitPass(const Lattice<D>& lattice, int axis)
      : close_(lattice, axis), axis_(axis), shape_(shape(lattice, axis)), size_(lattice.size()) {
    last_cell_ = static_cast<T>(cells_along<K>(lattice, axis) - 1);
    rows_ = static_cast<std::ptrdiff_t>(lattice.size()) / shape_.nodes;
    period_of_lanes_ = axis == 0 ? rows_ : shape_.stride;
  }

  /// \param displacement along the axis, in spacings
  /// \param in,out        strengths, then displacements to carry; out is overwritten
  /// \throws ValueError if the displacement leaves a node without particles, or particles go beyond a bounded face
  template <Execution E>
  void operator()(const T* displacement, const std::array<const T*, Strengths + Carried>& in,
                  const std::array<T*, Strengths + Carried>& out, const E& execution) {
    if (period_of_lanes_ >= static_cast<std::ptrdiff_t>(wide)) {
      run<wide>(displacement, in, out, execution);
    } else {
      run<1>(displacement, in, out, execution);
    }
  }

 private:
  static constexpr std::size_t wide = simd::native_lanes<T>;

  template <int D>
  static Shape shape(const Lattice<D>& lattice, int axis) {
    std::ptrdiff_t stride = 1;
    for (int d = 0; d < axis; ++d) stride *= lattice.nodes()[d];
    return {lattice.nodes()[axis], stride, axis == 0 ? lattice.nodes()[0] : 1};
  }
  /// Offset of line l: lines are numbered with the axes other than this one, the first of them fastest.
  std::ptrdiff_t offset(std::ptrdiff_t l) const {
    if (axis_ == 0) return l * shape_.nodes;
    return l % shape_.stride + l / shape_.stride * shape_.stride * shape_.nodes;
  }

  template <std::size_t L, Execution E>
  void run(const T* displacement, const std::array<const T*, Strengths + Carried>& in,
           const std::array<T*, Strengths + Carried>& out, const E& execution) {
    const auto lanes = static_cast<std::ptrdiff_t>(L);
    const std::ptrdiff_t groups_per_period = (period_of_lanes_ + lanes - 1) / lanes;
    const std::ptrdiff_t groups = rows_ / period_of_lanes_ * groups_per_period;
    const auto nodes = static_cast<std::size_t>(shape_.nodes);
    const std::size_t sums = nodes * fields * L;
    const std::size_t lines = axis_ == 0 ? nodes * (1 + Strengths + Carried) * L : 0;
    const auto workers = static_cast<std::size_t>(execution.count());
    const std::size_t share = sums + lines + 64;
    if (scratch_.size() < workers * share) scratch_.resize(workers * share);
    for_each_piece_by_worker(
        execution, static_cast<std::size_t>(groups), 8, [&](std::size_t worker, std::size_t begin, std::size_t end) {
          T* scratch = scratch_.data() + worker * share / 64 * 64;
          for (auto g = static_cast<std::ptrdiff_t>(begin); g < static_cast<std::ptrdiff_t>(end); ++g) {
            // The last group of a period is moved back to be full; its lines are done twice alike.
            const std::ptrdiff_t in_period = std::min(g % groups_per_period * lanes, period_of_lanes_ - lanes);
            const std::ptrdiff_t line = g / groups_per_period * period_of_lanes_ + in_period;
            move_lines<L>(offset(line), displacement, in, out, scratch, scratch + sums);
          }
        });
  }

  /// Moves L lines side by side.
  template <std::size_t L>
  void move_lines(std::ptrdiff_t first, const T* displacement, const std::array<const T*, Strengths + Carried>& in,
                  const std::array<T*, Strengths + Carried>& out, T* sum, T* line) const {
    const std::ptrdiff_t n = shape_.nodes;
    std::fill_n(sum, static_cast<std::size_t>(n) * fields * L, T(0));
    std::array<const T*, 1 + Strengths + Carried> from;
    from[0] = displacement + first;
    for (std::size_t m = 0; m < in.size(); ++m) from[m + 1] = in[m] + first;
    std::ptrdiff_t step = shape_.stride;
    if (L > 1 && axis_ == 0) {
      for (std::size_t m = 0; m < from.size(); ++m) {
        T* to = line + m * static_cast<std::size_t>(n) * L;
        transpose_in<L>(from[m], to);
        from[m] = to;
      }
      step = static_cast<std::ptrdiff_t>(L);
    }
    for (std::ptrdiff_t i = 0; i < n; ++i) scatter<L>(i, from, i * step, sum);
    if constexpr (Carried > 0) renormalise<L>(sum);
    for (std::size_t m = 0; m < out.size(); ++m) write<L>(sum, m, out[m] + first);
  }

  template <std::size_t L>
  void transpose_in(const T* from, T* to) const {
    for (std::size_t l = 0; l < L; ++l) {
      const T* row = from + static_cast<std::ptrdiff_t>(l) * shape_.lane_stride;
      for (std::ptrdiff_t i = 0; i < shape_.nodes; ++i)
        to[i * static_cast<std::ptrdiff_t>(L) + static_cast<std::ptrdiff_t>(l)] = row[i];
    }
  }
  template <std::size_t L>
  void write(const T* sum, std::size_t m, T* out) const {
    if (L > 1 && axis_ == 0) {
      for (std::size_t l = 0; l < L; ++l) {
        T* row = out + static_cast<std::ptrdiff_t>(l) * shape_.lane_stride;
        for (std::ptrdiff_t i = 0; i < shape_.nodes; ++i)
          row[i] = sum[(static_cast<std::size_t>(i) * fields + m) * L + l];
      }
    } else {
      for (std::ptrdiff_t i = 0; i < shape_.nodes; ++i) {
        simd::Pack<T, L>::load_aligned(sum + (static_cast<std::size_t>(i) * fields + m) * L)
            .store(out + i * shape_.stride);
      }
    }
  }

  /// Gives entry i of L lines to the nodes around where it has gone.
  template <std::size_t L>
  void scatter(std::ptrdiff_t i, const std::array<const T*, 1 + Strengths + Carried>& from, std::ptrdiff_t at,
               T* sum) const {
    using V = simd::Pack<T, L>;
    const V u = V::load(from[0] + at) + V(static_cast<T>(i) + static_cast<T>(Taps<K>::shift));
    V cell = floor(u);
    if (!close_.periodic()) cell = max(min(cell, V(last_cell_)), V(T(0)));
    const V g = u - cell - V(T(0.5));
    V value[fields];
    for (std::size_t m = 0; m + 1 < from.size(); ++m) value[m] = V::load(from[m + 1] + at);
    if constexpr (Carried > 0) value[fields - 1] = V(T(1));
    V weight[support];
    weigh<L>(g, weight);
    alignas(64) T cells[L];
    cell.store_aligned(cells);
    const auto [low, high] = std::minmax_element(cells, cells + L);
    for (T c = *low;; c += T(1)) {  // once, but where lanes move by different numbers of cells
      if (*low != *high) {
        V masked[support];
        for (std::size_t k = 0; k < support; ++k) masked[k] = where_equal(cell, V(c), weight[k], V(T(0)));
        add<L>(static_cast<std::ptrdiff_t>(c) - Taps<K>::before, masked, value, sum);
      } else {
        add<L>(static_cast<std::ptrdiff_t>(c) - Taps<K>::before, weight, value, sum);
      }
      if (!(c < *high)) break;
    }
  }
  template <std::size_t L>
  static void weigh(const simd::Pack<T, L>& g, simd::Pack<T, L> (&weight)[support]) {
    using V = simd::Pack<T, L>;
    if constexpr (Taps<K>::polynomial) {
      for (std::size_t k = 0; k < support; ++k) {
        V w(static_cast<T>(Taps<K>::coefficients.value[Taps<K>::degree][k]));
        for (int j = Taps<K>::degree - 1; j >= 0; --j)
          w = fma(w, g, V(static_cast<T>(Taps<K>::coefficients.value[j][k])));
        weight[k] = w;
      }
    } else {
      alignas(64) T offset[L], lane[support], all[support][L];
      g.store_aligned(offset);
      for (std::size_t l = 0; l < L; ++l) {
        Taps<K>::weights(offset[l], lane);
        for (std::size_t k = 0; k < support; ++k) all[k][l] = lane[k];
      }
      for (std::size_t k = 0; k < support; ++k) weight[k] = V::load(all[k]);
    }
  }
  template <std::size_t L>
  void add(std::ptrdiff_t node, const simd::Pack<T, L> (&weight)[support], const simd::Pack<T, L> (&value)[fields],
           T* sum) const {
    if (node >= 0 && node + static_cast<std::ptrdiff_t>(support) <= shape_.nodes) {
      for (std::size_t k = 0; k < support; ++k) add_to<L>(sum, node + static_cast<std::ptrdiff_t>(k), weight[k], value);
      return;
    }
    for (std::size_t k = 0; k < support; ++k) {
      std::ptrdiff_t i = node + static_cast<std::ptrdiff_t>(k);
      if (close_.periodic())
        i -= shape_.nodes *
             static_cast<std::ptrdiff_t>(std::floor(static_cast<double>(i) / static_cast<double>(shape_.nodes)));
      close_(i, [&](std::ptrdiff_t to, double w) {
        add_to<L>(sum, to, weight[k] * simd::Pack<T, L>(static_cast<T>(w)), value);
      });
    }
  }
  template <std::size_t L>
  static void add_to(T* sum, std::ptrdiff_t node, const simd::Pack<T, L>& weight,
                     const simd::Pack<T, L> (&value)[fields]) {
    using V = simd::Pack<T, L>;
    T* at = sum + static_cast<std::size_t>(node) * fields * L;
    for (std::size_t m = 0; m < fields; ++m)
      fma(weight, value[m], V::load_aligned(at + m * L)).store_aligned(at + m * L);
  }
  /// Carried values := sums / sum of weights.
  template <std::size_t L>
  void renormalise(T* sum) const {
    using V = simd::Pack<T, L>;
    V lowest(T(1));
    for (std::ptrdiff_t i = 0; i < shape_.nodes; ++i) {
      T* at = sum + static_cast<std::size_t>(i) * fields * L;
      const V weight = V::load_aligned(at + (fields - 1) * L);
      lowest = min(lowest, weight);
      const V inverse = V(T(1)) / weight;
      for (std::size_t m = Strengths; m + 1 < fields; ++m)
        (V::load_aligned(at + m * L) * inverse).store_aligned(at + m * L);
    }
    alignas(64) T lane[L];
    lowest.store_aligned(lane);
    const T worst = *std::min_element(lane, lane + L);
    if (worst >= smallest_weight) return;
    throw ValueError(message("split remeshing along axis ", axis_, " leaves a node with a sum of weights of ", worst,
                             " (1 for particles at rest): the particles have moved too far apart or past each other; "
                             "remesh after a shorter step, or use the strategy Tensor"));
  }

  static constexpr T smallest_weight = T(0.1);

  Closure<K> close_;
  int axis_;
  Shape shape_;
  std::size_t size_;
  T last_cell_{};
  std::ptrdiff_t rows_ = 0;
  std::ptrdiff_t period_of_lanes_ = 1;
  AlignedVector<T> scratch_;
};

}  // namespace cambium::detail
