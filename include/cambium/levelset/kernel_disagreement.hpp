// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <cambium/kernels/hat.hpp>
#include <cambium/levelset/jet.hpp>
#include <cambium/levelset/patch.hpp>

namespace cambium::detail {

/// How well kernel K knows a point of the interface: by the zero set of the interpolant of a finer kernel.
template <class K, class Finer, class T, int D>
class KernelDisagreement {
 public:
  /// What the zero set of K may be off by near y, in spacings: how far that of the finer kernel is. With a kink within
  /// their stencils both overshoot, sometimes alike, so that the linear interpolant, which does not, has a say: without
  /// it slabs up to four spacings thick moved at every reinitialisation.
  static T uncertainty(const Patch<T, D>& patch, const Vec<D, T>& y, const Jet<T, D>& jet) {
    const T error = difference<Finer>(patch, y, jet);
    if (K::moments < high_order || error < resolved) return error;
    const T of_linear = difference<Hat>(patch, y, jet);
    return error < smooth * of_linear ? error : std::max(error, share_of_linear * of_linear);
  }

 private:
  /// There is a kink if K and the finer kernel differ by so many spacings at least, and by that share of how far the
  /// linear interpolant is: next to kinks it is seldom less than 0.04, on smooth shapes it falls with the cube of the
  /// spacing. For kernels of low order this tells nothing.
  static constexpr T resolved = T(5e-4);
  static constexpr T smooth = T(0.02);
  static constexpr int high_order = 4;
  /// Those who ask grant twice the error, so that half of the distance to the linear interpolant's zero set would do
  /// for planes; the rest is for corners.
  static constexpr T share_of_linear = T(0.7);

  /// Distance between the zero sets of two kernels near y, in spacings: their values and, since these may agree by
  /// chance, half of a spacing times their gradients.
  template <class Other>
  static T difference(const Patch<T, D>& patch, const Vec<D, T>& y, const Jet<T, D>& jet) {
    const Jet<T, D> other = Interpolant<Other, T, D>::jet(patch.data(), patch.stride(), y);
    return (std::abs(other.value) + T(0.5) * norm(other.gradient - jet.gradient)) / norm(jet.gradient);
  }
};

}  // namespace cambium::detail
