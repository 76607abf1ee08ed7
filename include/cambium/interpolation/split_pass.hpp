// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <cambium/interpolation/line_scatter.hpp>
#include <cambium/simd/transpose.hpp>

namespace cambium::detail {

/// Layout of `lines` lines of equal length side by side: entry i of line l is at i * along + l * across. One of the
/// strides is 1.
struct LineTile {
  std::ptrdiff_t lines;
  std::ptrdiff_t along;
  std::ptrdiff_t across;
  bool stream = false;  // written past the caches where lines are contiguous
};

/// One pass of a split remeshing: moves strengths along lines of one axis by a displacement and remeshes each line.
///
/// Passes follow one another along different axes. A pass carries the displacements along the axes still to come with
/// it, as values (renormalised by the sum of the weights), so that the passes compose to the whole displacement: there
/// is no splitting error that an ordering after Strang would have to cancel. Every line must stay ordered, i.e. the
/// displacement may shear but not fold: 1 + d(displacement)/dx > 0 along each axis in turn, as under a Lagrangian CFL
/// number below 1.
template <class K, class T, int Strengths, int Carried>
class SplitPass {
 public:
  static constexpr int moved = Strengths + Carried;
  static constexpr int fields = LineScatter<K, T, moved, (Carried > 0)>::fields;
  static constexpr std::size_t wide = simd::native_lanes<T>;
  /// A node that gets less than this sum of weights has lost its particles.
  static constexpr T smallest_weight = T(0.1);

  template <int D>
  SplitPass(const Lattice<D>& lattice, int axis) : nodes_(lattice, axis), axis_(axis) {}

  /// Values of scratch that a call needs.
  std::size_t scratch_size() const {
    return (nodes_.size() * fields + static_cast<std::size_t>(nodes_.count()) * (moved + 1)) * wide;
  }

  /// \param displacement along the axis, in spacings, laid out as `from` says
  /// \param in           strengths, then displacements to carry, laid out as `from` says
  /// \param out          the same after the move, laid out as `to` says; must not overlap the input
  /// \param scratch      aligned, of scratch_size()
  /// \throws ValueError if carried displacements reach a node with a sum of weights below smallest_weight
  void operator()(const LineTile& from, const T* displacement, const std::array<const T*, moved>& in,
                  const LineTile& to, const std::array<T*, moved>& out, T* scratch) const {
    const auto lanes = static_cast<std::ptrdiff_t>(wide);
    if (std::min(from.lines, nodes_.count()) < lanes) {
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
    const std::ptrdiff_t n = nodes_.count();
    T* sum = scratch;
    const std::size_t sums = nodes_.size() * fields * L;
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
    const bool in_order = nodes_.template scatter<L>(source, step, sum);
    if (Carried > 0 && !in_order) require_order<L>(source[0], step);
    sum = nodes_.template close_ends<L>(sum);
    write<L>(sum, to, l, out);
  }
  /// Values can be carried only if no particle of a line has passed the next: 1 + d(displacement)/dx > 0. On periodic
  /// axes displacements are known up to a period.
  template <std::size_t L>
  [[gnu::noinline]] void require_order(const T* displacement, std::ptrdiff_t step) const {
    const std::ptrdiff_t n = nodes_.count();
    const Lanes<L> period(nodes_.periodic() ? static_cast<T>(n) : T(0));
    const Lanes<L> per_period(nodes_.periodic() ? T(1) / static_cast<T>(n) : T(0));
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
    for (std::ptrdiff_t i = 0; i < nodes_.count(); i += lanes) f(std::min(i, nodes_.count() - lanes));
  }
  /// Writes L lines from line l on, a block of nodes after the other, renormalised.
  template <std::size_t L>
  void write(T* sum, const LineTile& to, std::ptrdiff_t l, const std::array<T*, moved>& out) const {
    constexpr auto pitch = static_cast<std::ptrdiff_t>(fields * L), lanes = static_cast<std::ptrdiff_t>(L);
    Lanes<L> lowest(T(1));
    for (std::ptrdiff_t i = 0; i < nodes_.count(); i += lanes) {
      const std::ptrdiff_t end = std::min(i + lanes, nodes_.count());
      if constexpr (Carried > 0) {
        for (std::ptrdiff_t j = i; j < end; ++j) lowest = min(lowest, renormalise<L>(sum + j * pitch));
      }
      for (std::ptrdiff_t m = 0; m < moved; ++m) {
        T* line = out[m] + l * to.across;
        if (L > 1 && to.across != 1) {
          const std::ptrdiff_t first = end - lanes;
          simd::transpose<L>(sum + first * pitch + m * lanes, pitch, line + first, to.across, to.stream);
        } else {
          for (std::ptrdiff_t j = i; j < end; ++j) {
            Lanes<L>::load_aligned(sum + j * pitch + m * lanes).store(line + j * to.along);
          }
        }
      }
    }
    if constexpr (Carried > 0) require_weight(lowest_lane(lowest));
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

  LineScatter<K, T, moved, (Carried > 0)> nodes_;
  int axis_;
};

}  // namespace cambium::detail
