// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include <cambium/poisson/lane_fft.hpp>

namespace cambium::detail {

/// Fourier transforms of twice the length, 2 n, of complex lines of n + 1 values followed by zeros: even waves are a
/// transform of n points of the values, odd ones of the values times exp(-pi i j / n), so that no zero is touched.
/// Lines as in LaneFft.
template <class T>
class PaddedFft {
 public:
  using Lanes = typename LaneFft<T>::Lanes;
  static constexpr std::size_t width = LaneFft<T>::width;
  static constexpr std::size_t lines = LaneFft<T>::pitch;

  explicit PaddedFft(std::size_t cells) : fft_(cells) {
    for (std::size_t j = 0; j < cells; ++j) {
      const double angle = std::numbers::pi * static_cast<double>(j) / static_cast<double>(cells);
      turn_.emplace_back(static_cast<T>(std::cos(angle)), static_cast<T>(-std::sin(angle)));
    }
  }

  std::size_t cells() const { return fft_.size(); }
  /// Numbers in an array of half of the waves.
  std::size_t half_size() const { return cells() * lines; }

  /// waves := the even (parity 0) or odd (parity 1) waves of the n + 1 rows at from, from + pitch, ...: wave
  /// 2 k + parity is row k. `work` is overwritten.
  void forward(int parity, const T* from, std::size_t pitch, T* waves, T* work) const {
    T* const start = fft_.odd() ? work : waves;
    for (std::size_t half = 0; half < lines; half += width) {
      const Lanes first = Lanes::load_aligned(from + half), last = Lanes::load_aligned(from + cells() * pitch + half);
      (parity == 0 ? first + last : first - last).store_aligned(start + half);
    }
    for (std::size_t j = 1; j < cells(); ++j) {
      const Lanes re = Lanes::load_aligned(from + j * pitch), im = Lanes::load_aligned(from + j * pitch + width);
      T* const row = start + j * lines;
      if (parity == 0) {
        re.store_aligned(row);
        im.store_aligned(row + width);
      } else {
        turned(re, im, j, row);
      }
    }
    fft_.run(start, start == work ? waves : work);
  }

  /// First half of the way back, of waves with exchanged real and imaginary parts, for which back is forth.
  /// \return waves or work, whichever holds the result
  T* backward(T* waves, T* work) const {
    fft_.run(waves, work);
    return fft_.odd() ? work : waves;
  }
  /// The n + 1 rows, times 2 n, from what backward() gave for even and odd waves: with exchanged real and imaginary
  /// parts, or, if `restore`, as they should be.
  void join(const T* even, const T* odd, T* to, std::size_t pitch, bool restore) const {
    const std::size_t re = restore ? width : 0, im = width - re;
    for (std::size_t half = 0; half < lines; half += width) {
      const Lanes first = Lanes::load_aligned(even + half), second = Lanes::load_aligned(odd + half);
      (first + second).store_aligned(to + (half == 0 ? re : im));
      (first - second).store_aligned(to + cells() * pitch + (half == 0 ? re : im));
    }
    for (std::size_t j = 1; j < cells(); ++j) {
      const T* const a = even + j * lines;
      const T* const b = odd + j * lines;
      const Lanes cosine(turn_[j].real()), sine(turn_[j].imag());
      const Lanes x = Lanes::load_aligned(b), y = Lanes::load_aligned(b + width);
      (Lanes::load_aligned(a) + (x * cosine - y * sine)).store_aligned(to + j * pitch + re);
      (Lanes::load_aligned(a + width) + (x * sine + y * cosine)).store_aligned(to + j * pitch + im);
    }
  }

 private:
  void turned(const Lanes& re, const Lanes& im, std::size_t j, T* row) const {
    const Lanes cosine(turn_[j].real()), sine(turn_[j].imag());
    (re * cosine - im * sine).store_aligned(row);
    (re * sine + im * cosine).store_aligned(row + width);
  }

  LaneFft<T> fft_;
  std::vector<std::complex<T>> turn_;
};

}  // namespace cambium::detail
