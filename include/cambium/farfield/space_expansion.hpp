// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include <cambium/farfield/expansion.hpp>

namespace cambium::detail {

/// In space: 1 / |x - y| = Re sum_n sum_(m = 0)^n (2 - [m = 0]) conj R_n^m(y) S_n^m(x), with solid harmonics that are
/// regular, R, or irregular, S (as in Dehnen 2014, Computational Astrophysics and Cosmology 1, up to signs):
///   R_0^0 = 1,    R_(m+1)^(m+1) = (x + i y) R_m^m / (2 m + 2),  (n^2 - m^2) R_n^m = (2 n - 1) z R_(n-1)^m - r^2
///   R_(n-2)^m S_0^0 = 1 / r,  S_(m+1)^(m+1) = (2 m + 1) (x + i y) S_m^m / r^2, r^2 S_(n+1)^m = (2 n + 1) z S_n^m -
///   (n^2 - m^2) S_(n-1)^m
/// Derivatives of S are S again, one order up: d_z S_n^m = -S_(n+1)^m, (d_x + i d_y) S_n^m = -S_(n+1)^(m+1),
/// (d_x - i d_y) S_n^m = S_(n+1)^(m-1). So a gradient is three more sets of coefficients.
template <>
class Expansion<3> {
 public:
  static constexpr std::size_t most_order = 48;
  static constexpr std::size_t moments(std::size_t p) { return (p + 1) * (p + 2); }
  template <bool Gradient>
  static constexpr std::size_t prepared(std::size_t p) {
    return Gradient ? 4 * moments(p + 1) : moments(p);
  }
  template <bool Gradient>
  static double cost(std::size_t p) {
    return (Gradient ? 0.18 : 0.1) * static_cast<double>((p + 2) * (p + 2));
  }

  /// sums[n, m] += q R_n^m(y), order by order
  static void add(const std::array<FarLanes, 3>& y, const FarLanes& q, std::size_t p, FarLanes* sums) {
    const FarLanes square = fma(y[0], y[0], fma(y[1], y[1], y[2] * y[2]));
    FarLanes re = q, im(0.0);
    for (std::size_t m = 0; m <= p; ++m) {
      FarLanes below_re(0.0), below_im(0.0), now_re = re, now_im = im;
      for (std::size_t n = m; n <= p; ++n) {
        FarLanes* const sum = sums + at(n, m);
        sum[0] = sum[0] + now_re;
        sum[1] = sum[1] + now_im;
        const double share = 1.0 / static_cast<double>((n + 1) * (n + 1) - m * m);
        const FarLanes up = FarLanes(static_cast<double>(2 * n + 1) * share) * y[2], down = FarLanes(share) * square;
        const FarLanes next_re = up * now_re - down * below_re, next_im = up * now_im - down * below_im;
        below_re = now_re;
        below_im = now_im;
        now_re = next_re;
        now_im = next_im;
      }
      const FarLanes share(0.5 / static_cast<double>(m + 1));
      const FarLanes next = share * (re * y[0] - im * y[1]);
      im = share * (re * y[1] + im * y[0]);
      re = next;
    }
  }
  /// Coefficients of S_n^m from sums of q R_n^m.
  static void finish(std::size_t p, double* moment) {
    for (std::size_t n = 0; n <= p; ++n) {
      for (std::size_t m = 1; m <= n; ++m) {
        moment[at(n, m)] *= 2.0;
        moment[at(n, m) + 1] *= -2.0;
      }
    }
  }

  /// Coefficients in the order of evaluate(), imaginary parts with the sign of i^2.
  template <bool Gradient>
  static void prepare(const double* c, std::size_t p, double* to) {
    const std::size_t last = Gradient ? p + 1 : p;
    for (std::size_t m = 0; m <= last; ++m) {
      for (std::size_t n = m; n <= last; ++n) {
        const bool own = n <= p;
        *to++ = own ? c[at(n, m)] : 0.0;
        *to++ = own ? -c[at(n, m) + 1] : 0.0;
        if constexpr (Gradient) to = prepare_gradient(c, p, n, m, to);
      }
    }
  }

  template <bool Gradient>
  static void evaluate(const double* c, std::size_t p, const std::array<FarLanes, 3>& x, double radius,
                       FarSum<3>& sum) {
    constexpr std::size_t kinds = Gradient ? 4 : 1;
    const std::size_t last = Gradient ? p + 1 : p;
    const FarLanes inverse = FarLanes(1.0) / fma(x[0], x[0], fma(x[1], x[1], x[2] * x[2]));
    const FarLanes u = x[0] * inverse, v = x[1] * inverse, w = x[2] * inverse;
    FarLanes re = sqrt(inverse), im(0.0);
    std::array<FarLanes, kinds> real, imaginary;
    real.fill(im);
    imaginary.fill(im);
    for (std::size_t m = 0; m <= last; ++m) {
      FarLanes below_re(0.0), below_im(0.0), now_re = re, now_im = im;
      for (std::size_t n = m; n <= last; ++n, c += 2 * kinds) {
        for (std::size_t k = 0; k < kinds; ++k) {
          real[k] = fma(FarLanes(c[2 * k]), now_re, real[k]);
          imaginary[k] = fma(FarLanes(c[2 * k + 1]), now_im, imaginary[k]);
        }
        const FarLanes up = FarLanes(static_cast<double>(2 * n + 1)) * w;
        const FarLanes down = FarLanes(-static_cast<double>(n * n - m * m)) * inverse;
        const FarLanes next_re = fma(up, now_re, down * below_re), next_im = fma(up, now_im, down * below_im);
        below_re = now_re;
        below_im = now_im;
        now_re = next_re;
        now_im = next_im;
      }
      const FarLanes factor(static_cast<double>(2 * m + 1));
      const FarLanes next = factor * (re * u - im * v);
      im = factor * (re * v + im * u);
      re = next;
    }
    sum.potential = fma(FarLanes(1.0 / radius), real[0] + imaginary[0], sum.potential);
    if constexpr (Gradient) {
      const FarLanes scale(1.0 / (radius * radius));
      for (std::size_t d = 0; d < 3; ++d) {
        sum.gradient[d] = fma(scale, real[d + 1] + imaginary[d + 1], sum.gradient[d]);
      }
    }
  }

 private:
  static constexpr std::size_t at(std::size_t n, std::size_t m) { return n * (n + 1) + 2 * m; }

  /// Coefficients of S_n^m in the three derivatives; they come from order n - 1.
  static double* prepare_gradient(const double* c, std::size_t p, std::size_t n, std::size_t m, double* to) {
    double along[3][2] = {};
    const auto take = [&](std::size_t from, double x, double y, double z) {
      if (n == 0 || n - 1 > p || from > n - 1) return;
      const double re = c[at(n - 1, from)], im = c[at(n - 1, from) + 1];
      along[0][0] += x * re;
      along[0][1] += x * im;
      along[1][0] -= y * im;  // times i
      along[1][1] += y * re;
      along[2][0] += z * re;
      along[2][1] += z * im;
    };
    if (m > 0) take(m - 1, m == 1 ? -1.0 : -0.5, m == 1 ? 1.0 : 0.5, 0.0);
    take(m, 0.0, 0.0, -1.0);
    take(m + 1, 0.5, 0.5, 0.0);
    for (const auto& one : along) {
      *to++ = one[0];
      *to++ = m == 0 ? 0.0 : -one[1];
    }
    return to;
  }
};

}  // namespace cambium::detail
