// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/levelset/jet.hpp>

namespace cambium::detail {

/// The polynomial that a Lagrange kernel interpolates in one cell of the lattice: also a little outside of the cell.
template <class K, class T, int D>
class CellStencil {
 public:
  using Axis = TapJet<K, T>;
  using Lanes = typename Axis::Lanes;

  /// \param cell  first node of the cell in the patch
  /// \param x     from there, in spacings
  CellStencil(const Index<D>& cell, const Vec<D, T>& x, const Index<D>& stride) : stride_(stride) {
    for (int d = 0; d < D; ++d) {
      first_ += (cell[d] - Taps<K>::before) * stride[d];
      const Axis axis(x[d] - T(0.5));
      for (int m = 0; m < 2; ++m) axis.all(m).store_aligned(tap_[d][m]);
    }
  }
  T value(const T* values) const { return contract(values, -1); }
  /// Derivatives per spacing.
  Vec<D, T> gradient(const T* values) const {
    Vec<D, T> result;
    for (int d = 0; d < D; ++d) result[d] = contract(values, d);
    return result;
  }
  /// Adds `factor` times the weight of every node to values.
  void spread(T factor, T* values) const {
    for_each_row([&](std::ptrdiff_t at, int j, int k) {
      const T weight = factor * tap_[1][0][j] * (D == 3 ? tap_[D - 1][0][k] : T(1));
      for (int i = 0; i < K::support; ++i) values[at + i] += weight * tap_[0][0][i];
    });
  }

 private:
  template <class F>
  void for_each_row(F&& f) const {
    for (int k = 0; k < (D == 3 ? K::support : 1); ++k) {
      for (int j = 0; j < K::support; ++j) f(first_ + k * stride_[D - 1] * (D == 3) + j * stride_[1], j, k);
    }
  }
  /// The value, or its derivative along an axis.
  T contract(const T* values, int axis) const {
    Lanes total(T(0));
    for_each_row([&](std::ptrdiff_t at, int j, int k) {
      const T weight = tap_[1][axis == 1][j] * (D == 3 ? tap_[D - 1][axis == D - 1][k] : T(1));
      total = fma(Lanes::load(values + at), Lanes(weight), total);
    });
    return sum(total * Lanes::load_aligned(tap_[0][axis == 0]));
  }

  std::ptrdiff_t first_ = 0;
  Index<D> stride_;
  alignas(64) T tap_[D][2][Axis::lanes];
};

}  // namespace cambium::detail
