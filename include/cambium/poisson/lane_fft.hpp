// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <cambium/simd/pack.hpp>

namespace cambium::detail {

/// Complex Fourier transforms z_k = sum_j x_j exp(-2 pi i j k / n) of `width` lines at once, one line per SIMD lane.
///
/// Row j of an array holds the real parts of x_j of all lines, then the imaginary ones: `pitch` numbers, on a cache
/// line. Stockham's algorithm (Van Loan, Computational Frameworks for the Fast Fourier Transform, section 1.7) with
/// radix 8, 4 and 2, and as many operations as in the definition for each odd prime factor: lengths with small factors
/// are fast, a prime one costs n^2. Any length is exact to round-off.
template <class T>
class LaneFft {
 public:
  static constexpr std::size_t width = 64 / sizeof(T);
  static constexpr std::size_t pitch = 2 * width;
  using Lanes = simd::Pack<T, width>;

  explicit LaneFft(std::size_t size) : size_(size), root_(size) {
    for (std::size_t j = 0; j < size; ++j) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(size);
      root_[j] = {static_cast<T>(std::cos(angle)), static_cast<T>(-std::sin(angle))};
    }
    std::size_t rest = size;
    while (rest % 8 == 0) factors_.push_back(8), rest /= 8;
    while (rest % 4 == 0) factors_.push_back(4), rest /= 4;
    for (std::size_t prime = 2; rest > 1; ++prime) {
      while (rest % prime == 0) factors_.push_back(prime), rest /= prime;
    }
  }

  std::size_t size() const { return size_; }
  /// True if run() moves the data to the other array an odd number of times.
  bool odd() const { return factors_.size() % 2 == 1; }

  /// Transforms the rows of x; the result is in y if odd(), otherwise in x. Both are overwritten.
  void run(T* x, T* y) const {
    std::size_t length = size_;
    std::size_t stride = 1;
    for (const std::size_t radix : factors_) {
      if (radix == 8) {
        stage_8(length, stride, x, y);
      } else if (radix == 4) {
        stage_4(length, stride, x, y);
      } else if (radix == 2) {
        stage_2(length, stride, x, y);
      } else {
        stage_any(radix, length, stride, x, y);
      }
      length /= radix;
      stride *= radix;
      std::swap(x, y);
    }
  }

 private:
  struct Complex {
    Lanes re, im;
    static Complex load(const T* row) { return {Lanes::load_aligned(row), Lanes::load_aligned(row + width)}; }
    void store(T* row) const {
      re.store_aligned(row);
      im.store_aligned(row + width);
    }
    friend Complex operator+(const Complex& a, const Complex& b) { return {a.re + b.re, a.im + b.im}; }
    friend Complex operator-(const Complex& a, const Complex& b) { return {a.re - b.re, a.im - b.im}; }
    Complex times(const std::complex<T>& w) const {
      const Lanes real(w.real()), imag(w.imag());
      return {re * real - im * imag, re * imag + im * real};
    }
    Complex times_minus_i() const { return {im, Lanes(T(0)) - re}; }
  };

  /// Transforms of four points: z := a + b + c + d, a - i b - c + i d, ...
  static void four(const Complex& a, const Complex& b, const Complex& c, const Complex& d, Complex (&z)[4]) {
    const Complex even = a + c, odd = b + d, left = a - c, right = (b - d).times_minus_i();
    z[0] = even + odd;
    z[1] = left + right;
    z[2] = even - odd;
    z[3] = left - right;
  }

  void stage_8(std::size_t length, std::size_t stride, const T* x, T* y) const {
    const std::size_t part = length / 8;
    const std::size_t apart = pitch * stride;
    const Lanes diagonal(static_cast<T>(std::numbers::sqrt2 / 2.0));
    for (std::size_t p = 0; p < part; ++p) {
      for (std::size_t q = 0; q < stride; ++q) {
        const T* const from = x + pitch * q + apart * p;
        T* const to = y + pitch * q + apart * 8 * p;
        const auto point = [&](std::size_t l) { return Complex::load(from + l * apart * part); };
        Complex even[4], odd[4];
        four(point(0), point(2), point(4), point(6), even);
        four(point(1), point(3), point(5), point(7), odd);
        odd[1] = {diagonal * (odd[1].re + odd[1].im), diagonal * (odd[1].im - odd[1].re)};
        odd[2] = odd[2].times_minus_i();
        odd[3] = {diagonal * (odd[3].im - odd[3].re), Lanes(T(0)) - diagonal * (odd[3].re + odd[3].im)};
        for (std::size_t m = 0; m < 4; ++m) {
          const Complex low = even[m] + odd[m], high = even[m] - odd[m];
          (p == 0 || m == 0 ? low : low.times(root_[m * p * (size_ / length)])).store(to + m * apart);
          (p == 0 ? high : high.times(root_[(m + 4) * p * (size_ / length)])).store(to + (m + 4) * apart);
        }
      }
    }
  }

  /// What is left of `length` points, `stride` interleaved transforms; as for the other radices.
  void stage_4(std::size_t length, std::size_t stride, const T* x, T* y) const {
    const std::size_t quarter = length / 4;
    const std::size_t step = size_ / length;
    const std::size_t apart = pitch * stride;
    for (std::size_t p = 0; p < quarter; ++p) {
      const auto w1 = root_[p * step], w2 = root_[2 * p * step], w3 = root_[3 * p * step];
      for (std::size_t q = 0; q < stride; ++q) {
        const T* const from = x + pitch * q + apart * p;
        T* const to = y + pitch * q + apart * 4 * p;
        const auto point = [&](std::size_t l) { return Complex::load(from + l * apart * quarter); };
        Complex z[4];
        four(point(0), point(1), point(2), point(3), z);
        z[0].store(to);
        (p == 0 ? z[1] : z[1].times(w1)).store(to + apart);
        (p == 0 ? z[2] : z[2].times(w2)).store(to + 2 * apart);
        (p == 0 ? z[3] : z[3].times(w3)).store(to + 3 * apart);
      }
    }
  }

  void stage_2(std::size_t length, std::size_t stride, const T* x, T* y) const {
    const std::size_t half = length / 2;
    const std::size_t apart = pitch * stride;
    for (std::size_t p = 0; p < half; ++p) {
      const auto w = root_[p * (size_ / length)];
      for (std::size_t q = 0; q < stride; ++q) {
        const T* const from = x + pitch * q + apart * p;
        T* const to = y + pitch * q + apart * 2 * p;
        const Complex a = Complex::load(from), b = Complex::load(from + apart * half);
        (a + b).store(to);
        (a - b).times(w).store(to + apart);
      }
    }
  }

  void stage_any(std::size_t radix, std::size_t length, std::size_t stride, const T* x, T* y) const {
    const std::size_t part = length / radix;
    const std::size_t apart = pitch * stride;
    for (std::size_t p = 0; p < part; ++p) {
      for (std::size_t m = 0; m < radix; ++m) {
        const auto w = root_[p * m * (size_ / length)];
        for (std::size_t q = 0; q < stride; ++q) {
          const T* const from = x + pitch * q + apart * p;
          Complex sum = Complex::load(from);
          for (std::size_t l = 1; l < radix; ++l) {
            sum = sum + Complex::load(from + l * apart * part).times(root_[l * m % radix * (size_ / radix)]);
          }
          sum.times(w).store(y + pitch * q + apart * (radix * p + m));
        }
      }
    }
  }

  std::size_t size_;
  std::vector<std::complex<T>> root_;
  std::vector<std::size_t> factors_;
};

}  // namespace cambium::detail
