// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>

#include <cambium/kernels/lagrange4.hpp>
#include <cambium/kernels/lagrange6.hpp>
#include <cambium/operators/difference_weights.hpp>
#include <cambium/simd/pack.hpp>

namespace cambium {

/// Surface diffusion by the closest-point principle: of a function that is constant along normals the Laplacian is, on
/// the interface, the Laplace-Beltrami operator, div((1 - n n) grad c) = Lap c (Ruuth & Merriman 2008). Centred
/// differences of order 2 or 4 with the interpolation that does not spoil them, of degree Order + 1.
template <int Order>
struct SurfaceLaplacian {
  static_assert(Order == 2 || Order == 4, "cambium: the surface Laplacian has order 2 or 4");
  static constexpr int order = Order;
  /// Nodes that the stencil takes on either side.
  static constexpr std::ptrdiff_t reach = Order / 2;
  /// A node of the stencil differs from its middle along so many axes.
  static constexpr int axes = 1;
  /// Interpolation at closest points: its error over h^2 is that of the stencil.
  using Kernel = std::conditional_t<Order == 2, Lagrange4, Lagrange6>;

  /// to := (h^2 Laplacian + shift) from, at `count` entries from `at` on.
  template <class T, int D>
  static void row(const T* from, T* to, std::ptrdiff_t at, std::ptrdiff_t count, const Index<D>& stride, T shift) {
    constexpr auto lanes = static_cast<std::ptrdiff_t>(simd::native_lanes<T>);
    using Lanes = simd::Pack<T, simd::native_lanes<T>>;
    const Lanes centre(shift + static_cast<T>(D) * weight<T>(0));
    for (std::ptrdiff_t i = at; i < at + count; i += lanes) {
      Lanes sum = centre * Lanes::load(from + i);
      for (int k = 1; k <= reach; ++k) {
        Lanes around(T(0));
        for (int d = 0; d < D; ++d) {
          around = around + (Lanes::load(from + i + k * stride[d]) + Lanes::load(from + i - k * stride[d]));
        }
        sum = fma(Lanes(weight<T>(k)), around, sum);
      }
      sum.store(to + i);
    }
  }

 private:
  template <class T>
  static constexpr T weight(std::ptrdiff_t k) {
    return static_cast<T>(DifferenceTable<Order, 2>::centred[static_cast<std::size_t>(reach + k)]);
  }
};

}  // namespace cambium
