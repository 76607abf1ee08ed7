// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include <cambium/kernels/constant_math.hpp>
#include <cambium/kernels/mollifier.hpp>
#include <cambium/kernels/pse_kernel.hpp>

/// The normal distribution, of unit variance along each axis: Mollifier, and PSEKernel of second order.
struct Normal {
  static constexpr int order = 2;
  static constexpr double cutoff = 8.0;
  static constexpr double largest_spacing = 1.0;
  template <int D>
  static constexpr double zeroth_moment = 2.0;

  template <int D>
  static constexpr double radial(double rho2) {
    double scale = 1.0;
    for (int d = 0; d < D; ++d) scale /= cambium::square_root(2.0 * std::numbers::pi);
    return scale * cambium::exponential(-0.5 * rho2);
  }
  template <int D>
  static constexpr double laplacian(double rho2) {
    return 2.0 * radial<D>(rho2);
  }
  template <int D>
  static constexpr double gradient(double rho2) {
    return -radial<D>(rho2);
  }
};
