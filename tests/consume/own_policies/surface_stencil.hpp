// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/core/vec.hpp>
#include <cambium/kernels/lagrange4.hpp>

/// The Laplacian whose error is the same in all directions, nine points in 2D and nineteen in 3D: SurfaceStencil.
struct Isotropic {
  using Kernel = cambium::Lagrange4;
  static constexpr std::ptrdiff_t reach = 1;
  static constexpr int axes = 2;

  template <class T, int D>
  static void row(const T* from, T* to, std::ptrdiff_t at, std::ptrdiff_t count, const cambium::Index<D>& stride,
                  T shift) {
    for (std::ptrdiff_t i = at; i < at + count; ++i) {
      T cross(-2 * D * from[i]), diagonal(-2 * D * (D - 1) * from[i]);
      for (int d = 0; d < D; ++d) {
        cross += from[i + stride[d]] + from[i - stride[d]];
        for (int e = 0; e < d; ++e) {
          for (const std::ptrdiff_t step : {stride[d] + stride[e], stride[d] - stride[e]}) {
            diagonal += from[i + step] + from[i - step];
          }
        }
      }
      to[i] = shift * from[i] + T(2) / T(3) * cross + diagonal / T(6 * (D - 1));
    }
  }
};
