// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/farfield/expansion.hpp>

namespace cambium::detail {

/// In the plane: -log|z - y| = -log|z| + Re sum_(n > 0) (y / z)^n / n, complex numbers for points. The gradient is that
/// of the real part of a function whose derivative is -sum_(n >= 0) y^n / z^(n + 1).
template <>
class Expansion<2> {
 public:
  static constexpr std::size_t most_order = 64;
  static constexpr std::size_t moments(std::size_t p) { return 2 * (p + 1); }
  template <bool Gradient>
  static constexpr std::size_t prepared(std::size_t p) {
    return moments(p) * (Gradient ? 2 : 1);
  }
  template <bool Gradient>
  static double cost(std::size_t p) {
    return 8.0 + static_cast<double>(p) * (Gradient ? 0.9 : 0.7);
  }

  /// sums[n] += q y^n
  static void add(const std::array<FarLanes, 2>& y, const FarLanes& q, std::size_t p, FarLanes* sums) {
    FarLanes re = q, im(0.0);
    for (std::size_t n = 0; n <= p; ++n) {
      sums[2 * n] = sums[2 * n] + re;
      sums[2 * n + 1] = sums[2 * n + 1] + im;
      const FarLanes next = re * y[0] - im * y[1];
      im = re * y[1] + im * y[0];
      re = next;
    }
  }
  static void finish(std::size_t, double*) {}

  /// Coefficients from the highest order down: of the potential, divided by n, and of the derivative.
  template <bool Gradient>
  static void prepare(const double* moment, std::size_t p, double* to) {
    for (std::size_t n = p + 1; n-- > 0;) {
      const double share = n == 0 ? 1.0 : 1.0 / static_cast<double>(n);
      for (std::size_t part = 0; part < 2; ++part) {
        *to++ = share * moment[2 * n + part];
        if (Gradient) *to++ = moment[2 * n + part];
      }
    }
  }

  template <bool Gradient>
  static void evaluate(const double* c, std::size_t p, const std::array<FarLanes, 2>& x, double radius,
                       FarSum<2>& sum) {
    constexpr std::size_t pitch = Gradient ? 4 : 2, imaginary = Gradient ? 2 : 1;
    const FarLanes square = fma(x[0], x[0], x[1] * x[1]);
    const FarLanes inverse = FarLanes(1.0) / square;
    const FarLanes u = x[0] * inverse, v = FarLanes(0.0) - x[1] * inverse;  // w = 1 / z
    FarLanes re(0.0), im(0.0), slope_re(0.0), slope_im(0.0);
    for (std::size_t n = 0; n < p; ++n, c += pitch) {
      multiply(re, im, u, v, c[0], c[imaginary]);
      if constexpr (Gradient) multiply(slope_re, slope_im, u, v, c[1], c[3]);
    }
    const FarLanes tail = re * u - im * v;
    sum.potential = sum.potential + tail - FarLanes(0.5 * c[0]) * (log(square) + FarLanes(2.0 * std::log(radius)));
    if constexpr (Gradient) {
      multiply(slope_re, slope_im, u, v, c[1], c[3]);
      const FarLanes scale(1.0 / radius);
      sum.gradient[0] = sum.gradient[0] - scale * (slope_re * u - slope_im * v);
      sum.gradient[1] = sum.gradient[1] + scale * (slope_re * v + slope_im * u);
    }
  }

 private:
  /// z := z w + c
  static void multiply(FarLanes& re, FarLanes& im, const FarLanes& u, const FarLanes& v, double c_re, double c_im) {
    const FarLanes next = fma(re, u, FarLanes(c_re) - im * v);
    im = fma(re, v, fma(im, u, FarLanes(c_im)));
    re = next;
  }
};

}  // namespace cambium::detail
