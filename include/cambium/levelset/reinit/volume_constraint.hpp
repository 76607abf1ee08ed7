// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#include <cambium/levelset/reinit/band_work.hpp>

namespace cambium::detail {

/// Keeps, during a reinitialisation, the volume that the interface cuts from every cell (Sussman & Fatemi 1999, eq.
/// 18): phi += lambda f, f = H'(phi_0) |grad phi_0|, with lambda such that the integral of H'(phi_0) (phi - phi_0) over
/// the cell around each node is zero. H is a step smoothed over 1.5 spacings to either side, so that phi_0 has to be
/// near a distance for this to be about volume.
template <class T, int D>
class VolumeConstraint {
 public:
  using Band = NarrowBand<T, D>;

  /// Takes phi_0.
  template <Execution E>
  void start(const Band& band, const E& execution) {
    const Band& start = copy_band(band, start_);
    weight_.resize(band.blocks() * Band::volume);
    patches_.resize(static_cast<std::size_t>(execution.count()));
    for_each_patch(start, 2, execution, [&](const Patch<T, D>& patch, std::size_t b) {
      const T h = static_cast<T>(band.spacing());
      for (std::size_t i = 0; i < Band::volume; ++i) {
        const T* at = patch.data() + patch.entry(i);
        const T delta = step_slope(at[0], h);
        const T f = delta * std::sqrt(centred_square<T, D>(at, patch.stride())) / h;
        T integral{};
        if (f != T(0)) {
          integral = quadrature(patch.stride(), [&](std::ptrdiff_t s) {
            const T there = step_slope(at[s], h);
            return there * there * std::sqrt(centred_square<T, D>(at + s, patch.stride())) / h;
          });
        }
        weight_[b * Band::volume + i] = integral > T(0) ? f / integral : T(0);
      }
    });
  }
  /// corrected := tentative + lambda f.
  template <Execution E>
  void operator()(const Band& tentative, Band& corrected, const E& execution) {
    other_patches_.resize(static_cast<std::size_t>(execution.count()));
    const T h = static_cast<T>(tentative.spacing());
    for_each_piece_by_worker(execution, tentative.blocks(), 1, [&](std::size_t w, std::size_t b, std::size_t) {
      const auto from = tentative.values().block(b);
      const auto to = corrected.values().block(b);
      std::copy(from.begin(), from.end(), to.begin());
      const T* weight = weight_.data() + b * Band::volume;
      if (std::all_of(weight, weight + Band::volume, [](T value) { return value == T(0); })) return;
      Patch<T, D>& now = patches_[w];
      Patch<T, D>& start = other_patches_[w];
      now.read_block(tentative, b, 1);
      start.read_block(*start_, b, 1);
      for (std::size_t i = 0; i < Band::volume; ++i) {
        if (weight[i] == T(0)) continue;
        const T* at = start.data() + start.entry(i);
        const T* change = now.data() + now.entry(i);
        to[i] -= weight[i] * quadrature(start.stride(),
                                        [&](std::ptrdiff_t s) { return step_slope(at[s], h) * (change[s] - at[s]); });
      }
    });
  }

 private:
  template <Execution E, class F>
  void for_each_patch(const Band& band, std::ptrdiff_t halo, const E& execution, F&& f) {
    for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
      patches_[worker].read_block(band, b, halo);
      f(static_cast<const Patch<T, D>&>(patches_[worker]), b);
    });
  }
  /// H', the derivative of the smoothed step.
  static T step_slope(T phi, T h) {
    const T width = T(1.5) * h;
    if (!(std::abs(phi) < width)) return T(0);
    return T(0.5) / width * (T(1) + std::cos(std::numbers::pi_v<T> * phi / width));
  }
  /// Mean of f over the cell around a node: two thirds at the node, the rest at the 3^D - 1 nodes around it.
  template <class F>
  static T quadrature(const Index<D>& stride, F&& f) {
    T sum{};
    constexpr int count = D == 2 ? 9 : 27;
    for (int k = 0; k < count; ++k) {
      std::ptrdiff_t s = 0;
      for (int d = 0, rest = k; d < D; ++d, rest /= 3) s += (rest % 3 - 1) * stride[d];
      sum += f(s);
    }
    const T share = T(1) / static_cast<T>(3 * (count - 1));
    return share * sum + (T(2) / T(3) - share) * f(0);
  }

  std::optional<Band> start_;
  AlignedVector<T> weight_;
  std::vector<Patch<T, D>> patches_;
  std::vector<Patch<T, D>> other_patches_;
};

}  // namespace cambium::detail
