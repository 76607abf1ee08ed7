// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <cambium/levelset/reinit/band_work.hpp>
#include <cambium/levelset/weno.hpp>

namespace cambium::detail {

/// A node with a neighbour on the other side of the interface.
template <class T, int D>
struct NearNode {
  std::size_t node = 0;             ///< its number in the block
  T sign{};                         ///< of phi: -1 or 1, 0 if the node is on the interface
  T distance{};                     ///< to the interface, signed, second order, in length units
  std::array<T, 2 * D> crossing{};  ///< spacings to the interface along each axis, behind and ahead; above 1 for none
  T step{};                         ///< stable pseudo-time step over that of other nodes
};

/// Where in the cell between values f0 and f1 of different sign the cubic through four nodes is zero, from 0 to 1.
template <class T>
T cubic_crossing(T before, T f0, T f1, T behind) {
  if (f0 == T(0)) return T(0);
  // Newton's form, nodes 0, 1, -1, 2.
  const T a = f1 - f0;
  const T b = T(0.5) * (before - T(2) * f0 + f1);
  const T c = (behind - T(3) * f1 + T(3) * f0 - before) / T(6);
  T low = T(0), high = T(1);
  T t = f0 / (f0 - f1);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const T bend = t * (t - T(1));
    const T value = f0 + a * t + bend * (b + c * (t + T(1)));
    ((value < T(0)) == (f0 < T(0)) ? low : high) = t;
    const T slope = a + (T(2) * t - T(1)) * (b + c * (t + T(1))) + bend * c;
    T next = slope == T(0) ? low : t - value / slope;
    if (!(next > low && next < high)) next = T(0.5) * (low + high);
    const bool done = std::abs(next - t) <= T(4) * std::numeric_limits<T>::epsilon();
    t = next;
    if (done) break;
  }
  return t;
}

/// The nodes next to the interface of a band, by block, with the distance that phi tells before it is changed.
template <class T, int D>
class NearNodes {
 public:
  using Band = NarrowBand<T, D>;
  /// Nodes that are read on either side.
  static constexpr std::ptrdiff_t reach = 2;

  void resize(std::size_t blocks) {
    if (of_block_.size() < blocks) of_block_.resize(blocks);
  }
  /// Finds those of block b, which is in the patch with a halo of `reach` nodes at least.
  void find(const Band& band, std::size_t b, const Patch<T, D>& patch) {
    of_block_[b].clear();
    for (std::size_t i = 0; i < Band::volume; ++i) {
      const T* at = patch.data() + patch.entry(i);
      if (!crossed(at, patch.stride()) || !band.lattice().contains(band.values().node(b, i))) continue;
      of_block_[b].push_back(describe(i, at, patch.stride(), static_cast<T>(band.spacing())));
    }
  }
  const std::vector<NearNode<T, D>>& operator[](std::size_t b) const { return of_block_[b]; }

 private:
  static bool crossed(const T* at, const Index<D>& stride) {
    for (int d = 0; d < D; ++d) {
      for (const std::ptrdiff_t s : {-stride[d], stride[d]}) {
        if ((at[0] < T(0)) != (at[s] < T(0))) return true;
      }
    }
    return false;
  }
  static NearNode<T, D> describe(std::size_t i, const T* at, const Index<D>& stride, T h) {
    NearNode<T, D> near;
    near.node = i;
    near.sign = at[0] < T(0) ? T(-1) : T(1);
    T inverse{};
    T steepest{};
    bool on_interface = at[0] == T(0);
    for (int d = 0; d < D; ++d) {
      T slope{};
      for (const int way : {-1, 1}) {
        const std::ptrdiff_t s = way * stride[d];
        T& crossing = near.crossing[static_cast<std::size_t>(2 * d + (way > 0 ? 1 : 0))];
        const bool crosses = (at[0] < T(0)) != (at[s] < T(0));
        crossing = crosses ? cubic_crossing(at[-s], at[0], at[s], at[2 * s]) : T(2);
        on_interface |= crossing < nearest;
        slope = std::max(slope, std::abs(at[s] - at[0]));
      }
      const T closer =
          std::min(near.crossing[static_cast<std::size_t>(2 * d)], near.crossing[static_cast<std::size_t>(2 * d + 1)]);
      if (closer <= T(1) && !on_interface) inverse += T(1) / (closer * closer);
      steepest += slope * slope;
    }
    // Russo & Smereka 2000, eq. 12-15: centred differences, one-sided ones where those vanish (two fronts approach).
    const T centred = centred_square<T, D>(at, stride);
    near.distance = h * at[0] / std::sqrt(centred > T(0.25) * steepest ? centred : steepest);
    if (on_interface) near.sign = T(0);
    near.step = on_interface ? T(0) : std::min(T(1), T(1) / std::sqrt(inverse));
    return near;
  }

  /// A node that is nearer than this to the interface, in spacings, is on it.
  static constexpr T nearest = sizeof(T) == 8 ? T(1e-9) : T(1e-4);

  std::vector<std::vector<NearNode<T, D>>> of_block_;
};

/// One-sided derivative, in spacings, towards an interface that is `crossing` spacings from the node along `way`.
///
/// From the cubic through the interface, where phi is 0, the node, its neighbour on the same side and the second node
/// on the other (after du Chene, Min & Gibou 2008, section 2). A stencil with two nodes ahead and none behind would be
/// as accurate, but its weight of the node itself, 1 / crossing - 3/2, is negative beyond 2/3: phi then runs away. From
/// the straight line where phi has a kink or a second front is near.
/// \param at    the node; `stride` that of the axis
/// \param most  second divided differences above this are kinks
template <class T>
T derivative_to_interface(const T* at, std::ptrdiff_t stride, T crossing, int way, T most) {
  const std::ptrdiff_t s = -way * stride;
  const T a = at[0] / crossing;
  const T b = (at[s] - at[0] - a) / (T(1) + crossing);
  const T c = (at[s] - at[0] - T(0.5) * (at[0] - at[-2 * s])) / T(3);
  const bool one_front = at[0] * at[s] > T(0) && at[0] * at[-2 * s] < T(0);
  const bool smooth = one_front && std::abs(b) < most && std::abs(c) < most;
  const T slope = smooth ? a + crossing * (b - (b - c) / (T(2) - crossing)) : a;
  return static_cast<T>(-way) * slope;
}

/// Godunov's |grad phi| in spacings at a node next to the interface, whose place is part of the stencils.
template <class Scheme, class T, int D>
T subcell_gradient(const NearNode<T, D>& near, const T* at, const Index<D>& stride, T spacing) {
  T sum{};
  for (int d = 0; d < D; ++d) {
    const NodeDifferences<Scheme, T> differences = node_differences<Scheme>(at, stride[d]);
    T side[2];
    for (int k = 0; k < 2; ++k) {
      const T crossing = near.crossing[static_cast<std::size_t>(2 * d + k)];
      if (crossing <= T(1)) {
        side[k] = derivative_to_interface(at, stride[d], crossing, k == 0 ? -1 : 1, T(0.5) * spacing);
      } else {
        side[k] = k == 0 ? differences.left() : differences.right();
      }
    }
    sum += godunov_square(side[0], side[1], near.sign);
  }
  return std::sqrt(sum);
}

}  // namespace cambium::detail
