// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include <cambium/levelset/jet.hpp>
#include <cambium/levelset/patch.hpp>

namespace cambium::detail {

/// Weights of N = 2 or 4 nodes around a cell, and of their first two derivatives, for the polynomial of degree N - 1
/// through them (Lagrange) at u in [0, 1] of the cell, or a little beyond.
template <class T, int N>
class LagrangeWeights {
 public:
  static_assert(N == 2 || N == 4);
  using Lanes = simd::Pack<T, N>;

  explicit LagrangeWeights(T u) {
    if constexpr (N == 2) {
      tap_[0] = {T(1) - u, u};
      tap_[1] = {T(-1), T(1)};
      tap_[2] = {};
    } else {
      const T square = u * u;
      const T cube = square * u;
      constexpr T sixth = static_cast<T>(1.0 / 6.0);
      constexpr T half = T(0.5);
      // -u(u-1)(u-2)/6, (u+1)(u-1)(u-2)/2, -(u+1)u(u-2)/2, (u+1)u(u-1)/6
      tap_[0] = {(T(3) * square - T(2) * u - cube) * sixth, (T(2) - u - T(2) * square + cube) * half,
                 (T(2) * u + square - cube) * half, (cube - u) * sixth};
      tap_[1] = {(T(6) * u - T(2) - T(3) * square) * sixth, (T(3) * square - T(4) * u - T(1)) * half,
                 (T(2) + T(2) * u - T(3) * square) * half, (T(3) * square - T(1)) * sixth};
      tap_[2] = {T(1) - u, T(3) * u - T(2), T(1) - T(3) * u, u};
    }
  }
  T tap(int m, int k) const { return tap_[static_cast<std::size_t>(m)][static_cast<std::size_t>(k)]; }
  Lanes all(int m) const { return Lanes::load_aligned(tap_[static_cast<std::size_t>(m)].data()); }

 private:
  struct alignas(32) Row : std::array<T, N> {};
  std::array<Row, 3> tap_;
};

/// The polynomial of degree N - 1 along each axis through the N^D nodes around one cell of a patch: bilinear and
/// trilinear for N = 2, bicubic and tricubic for N = 4.
template <class T, int D, int N>
class CellPolynomial {
 public:
  /// \param low  the lowest corner of the cell, in whole spacings from entry 0 of the patch
  CellPolynomial(const Patch<T, D>& patch, const Vec<D, T>& low) : stride_(patch.stride()) {
    std::ptrdiff_t first = 0;
    for (int d = 0; d < D; ++d) first += (static_cast<std::ptrdiff_t>(low[d]) - (N / 2 - 1)) * stride_[d];
    first_ = patch.data() + first;
  }

  /// Value and derivatives up to `Order` = 1 or 2 at u, in spacings from the lowest corner of the cell; the others are
  /// 0.
  template <int Order>
  Jet<T, D> jet(const Vec<D, T>& u) const {
    const Weights x(u[0]);
    const Weights y(u[1]);
    Lanes sum[Order + 1][Order + 1];
    if constexpr (D == 2) {
      Lanes along[Order + 1];
      add_rows<Order>(first_, y, along);
      for (int m = 0; m <= Order; ++m) sum[m][0] = along[m];
    } else {
      add_planes<Order>(y, Weights(u[2]), sum);
    }
    return contract<Order>(x, sum);
  }

 private:
  using Weights = LagrangeWeights<T, N>;
  using Lanes = typename Weights::Lanes;
  template <int Order>
  using Plane = Lanes[Order + 1][Order + 1];

  template <int Order>
  void add_rows(const T* from, const Weights& y, Lanes (&along)[Order + 1]) const {
    // Sums start from their first term: g++ 12 misaligns arrays of vectors that it clears in a leaf function.
    const Lanes first = Lanes::load(from);
    for (int m = 0; m <= Order; ++m) along[m] = first * Lanes(y.tap(m, 0));
    for (int j = 1; j < N; ++j) {
      const Lanes values = Lanes::load(from + j * stride_[1]);
      for (int m = 0; m <= Order; ++m) along[m] = fma(values, Lanes(y.tap(m, j)), along[m]);
    }
  }
  template <int Order>
  void add_planes(const Weights& y, const Weights& z, Plane<Order>& sum) const {
    for (int k = 0; k < N; ++k) {
      Lanes along[Order + 1];
      add_rows<Order>(first_ + k * stride_[D - 1], y, along);
      for (int l = 0; l <= Order; ++l) {
        const Lanes weight(z.tap(l, k));
        for (int m = 0; m + l <= Order; ++m) sum[m][l] = k == 0 ? along[m] * weight : fma(along[m], weight, sum[m][l]);
      }
    }
  }
  template <int Order>
  static Jet<T, D> contract(const Weights& x, const Plane<Order>& plane) {
    const auto at = [&](int n, int m, int l) { return sum(x.all(n) * plane[m][l]); };
    Jet<T, D> jet;
    jet.value = at(0, 0, 0);
    jet.gradient[0] = at(1, 0, 0);
    jet.gradient[1] = at(0, 1, 0);
    if constexpr (D == 3) jet.gradient[2] = at(0, 0, 1);
    if constexpr (Order == 2) {
      jet.hessian[0][0] = at(2, 0, 0);
      jet.hessian[0][1] = jet.hessian[1][0] = at(1, 1, 0);
      jet.hessian[1][1] = at(0, 2, 0);
    }
    if constexpr (D == 3 && Order == 2) {
      jet.hessian[0][2] = jet.hessian[2][0] = at(1, 0, 1);
      jet.hessian[1][2] = jet.hessian[2][1] = at(0, 1, 1);
      jet.hessian[2][2] = at(0, 0, 2);
    }
    return jet;
  }

  const T* first_;
  Index<D> stride_;
};

}  // namespace cambium::detail
