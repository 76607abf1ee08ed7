// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include <cambium/poisson/boundary.hpp>
#include <cambium/poisson/lane_fft.hpp>

namespace cambium::detail {

/// The transform that diagonalises differences along an axis of `cells` = n cells, of 2 `width` lines at once:
///   dirichlet  y_k = sum_j x_j sin(pi j k / n), j, k = 1, ..., n - 1  (DST-I without its factor 2)
///   neumann    y_k = sum_j x_j cos(pi j k / n), j, k = 0, ..., n, with half of x_0 and x_n  (DCT-I without its 2)
///   periodic   y_k = sum_j x_j (cos + sin)(2 pi j k / n), j, k = 0, ..., n - 1  (Hartley's)
/// Each is its own inverse but for the factor norm(). Two real lines make one complex line of a Fourier transform of n
/// points (Cooley, Lewis, Welch 1970): sines and cosines by the sums and differences of x_j and x_(n-j), every other
/// result being a running sum.
template <class T>
class LineTransform {
 public:
  using Fft = LaneFft<T>;
  using Lanes = typename Fft::Lanes;
  static constexpr std::size_t width = Fft::width;
  /// Lines that are transformed at once: the numbers in a row.
  static constexpr std::size_t lines = Fft::pitch;

  LineTransform(Boundary boundary, std::size_t cells) : boundary_(boundary), cells_(cells), fft_(cells) {
    for (std::size_t j = 0; j <= cells; ++j) {
      const double angle = std::numbers::pi * static_cast<double>(j) / static_cast<double>(cells);
      sine_.push_back(static_cast<T>(std::sin(angle)));
      cosine_.push_back(static_cast<T>(std::cos(angle)));
    }
  }

  Boundary boundary() const { return boundary_; }
  std::size_t cells() const { return cells_; }
  /// Number of values on a line.
  std::size_t size() const {
    return boundary_ == Boundary::dirichlet ? cells_ - 1 : boundary_ == Boundary::neumann ? cells_ + 1 : cells_;
  }
  /// Node of the first value.
  std::size_t first() const { return boundary_ == Boundary::dirichlet ? 1 : 0; }
  /// Transforming twice multiplies by this.
  double norm() const { return (boundary_ == Boundary::periodic ? 1.0 : 0.5) * static_cast<double>(cells_); }
  /// Phase per node of wave number k = 0, ..., size() - 1, in [0, pi].
  double phase(std::size_t k) const {
    const auto n = static_cast<double>(cells_);
    if (boundary_ != Boundary::periodic) return std::numbers::pi * static_cast<double>(k + first()) / n;
    return 2.0 * std::numbers::pi * static_cast<double>(2 * k <= cells_ ? k : cells_ - k) / n;
  }
  /// Numbers in each of the two work arrays of run(), which must be on a cache line.
  std::size_t work_size() const { return cells_ * lines; }

  /// Transforms the rows from + r from_pitch into the rows to + r to_pitch, r = 0, ..., size() - 1, of `lines` numbers
  /// each, on a cache line; they may be the same.
  void run(const T* from, std::size_t from_pitch, T* to, std::size_t to_pitch, T* a, T* b) const {
    run(from, from_pitch, size(), to, to_pitch, size(), a, b);
  }
  /// The same; along a periodic axis only the first `given` rows are read, the others being zero, and only the first
  /// `wanted` ones written.
  void run(const T* from, std::size_t from_pitch, std::size_t given, T* to, std::size_t to_pitch, std::size_t wanted,
           T* a, T* b) const {
    T* const start = fft_.odd() ? a : b;
    Lanes odd[2] = {Lanes(T(0)), Lanes(T(0))};
    switch (boundary_) {
      case Boundary::dirichlet:
        fold_sine(from, from_pitch, start);
        break;
      case Boundary::neumann:
        fold_cosine(from, from_pitch, start, odd);
        break;
      case Boundary::periodic:
        for (std::size_t j = 0; j < given; ++j) copy_row(from + j * from_pitch, start + j * lines);
        std::fill(start + given * lines, start + cells_ * lines, T(0));
    }
    fft_.run(start, fft_.odd() ? b : a);
    switch (boundary_) {
      case Boundary::dirichlet:
        return unfold_sine(b, to, to_pitch);
      case Boundary::neumann:
        return unfold_cosine(b, to, to_pitch, odd);
      case Boundary::periodic:
        return unfold_hartley(b, to, to_pitch, wanted);
    }
  }

 private:
  static Lanes load(const T* row, int half) { return Lanes::load_aligned(row + (half == 0 ? 0 : width)); }
  static void store(const Lanes& value, T* row, int half) { value.store_aligned(row + (half == 0 ? 0 : width)); }
  static void copy_row(const T* from, T* to) {
    for (int half = 0; half < 2; ++half) store(load(from, half), to, half);
  }

  /// y_j = sin(pi j / n) (x_j + x_(n-j)) + (x_j - x_(n-j)) / 2, where row 0 holds x_1
  void fold_sine(const T* x, std::size_t pitch, T* y) const {
    for (int half = 0; half < 2; ++half) store(Lanes(T(0)), y, half);
    for (std::size_t j = 1; 2 * j <= cells_; ++j) {
      for (int half = 0; half < 2; ++half) {
        const Lanes left = load(x + (j - 1) * pitch, half), right = load(x + (cells_ - j - 1) * pitch, half);
        const Lanes even = Lanes(sine_[j]) * (left + right), odd = Lanes(T(0.5)) * (left - right);
        store(even + odd, y + j * lines, half);
        store(even - odd, y + (cells_ - j) * lines, half);
      }
    }
  }
  /// y_j = (x_j + x_(n-j)) / 2 - sin(pi j / n) (x_j - x_(n-j)); first := result 1, which nothing else tells.
  void fold_cosine(const T* x, std::size_t pitch, T* y, Lanes (&first)[2]) const {
    for (int half = 0; half < 2; ++half) {
      const Lanes left = load(x, half), right = load(x + cells_ * pitch, half);
      store(Lanes(T(0.5)) * (left + right), y, half);
      first[half] = Lanes(T(0.5)) * (left - right);
    }
    for (std::size_t j = 1; 2 * j <= cells_; ++j) {
      for (int half = 0; half < 2; ++half) {
        const Lanes left = load(x + j * pitch, half), right = load(x + (cells_ - j) * pitch, half);
        const Lanes even = Lanes(T(0.5)) * (left + right), odd = Lanes(sine_[j]) * (left - right);
        store(even - odd, y + j * lines, half);
        store(even + odd, y + (cells_ - j) * lines, half);
        if (2 * j < cells_) first[half] = first[half] + Lanes(cosine_[j]) * (left - right);
      }
    }
  }

  /// Sums of cosines and of sines of the two real lines in each complex one, from z_k and z_(n-k).
  struct Sums {
    Lanes cosine[2];
    Lanes sine[2];
  };
  Sums sums(const T* z, std::size_t k) const {
    const T* const row = z + k * lines;
    const T* const mirror = z + (k == 0 ? 0 : cells_ - k) * lines;
    const Lanes half(T(0.5));
    const Lanes re = load(row, 0), im = load(row, 1), mirror_re = load(mirror, 0), mirror_im = load(mirror, 1);
    return {{half * (re + mirror_re), half * (im + mirror_im)}, {half * (mirror_im - im), half * (re - mirror_re)}};
  }

  void unfold_sine(const T* z, T* y, std::size_t pitch) const {
    Lanes odd[2] = {Lanes(T(0)), Lanes(T(0))};
    for (std::size_t k = 0; 2 * k < cells_; ++k) {
      const Sums sum = sums(z, k);
      for (int half = 0; half < 2; ++half) {
        odd[half] = k == 0 ? Lanes(T(0.5)) * sum.cosine[half] : odd[half] + sum.cosine[half];
        if (k > 0) store(sum.sine[half], y + (2 * k - 1) * pitch, half);
        if (2 * k + 1 < cells_) store(odd[half], y + 2 * k * pitch, half);
      }
    }
  }
  void unfold_cosine(const T* z, T* y, std::size_t pitch, Lanes (&odd)[2]) const {
    for (std::size_t k = 0; 2 * k <= cells_; ++k) {
      const Sums sum = sums(z, k);
      for (int half = 0; half < 2; ++half) {
        if (k > 0) odd[half] = odd[half] + sum.sine[half];
        store(sum.cosine[half], y + 2 * k * pitch, half);
        if (2 * k + 1 <= cells_) store(odd[half], y + (2 * k + 1) * pitch, half);
      }
    }
  }
  void unfold_hartley(const T* z, T* y, std::size_t pitch, std::size_t wanted) const {
    for (std::size_t k = 0; k < wanted; ++k) {
      const Sums sum = sums(z, k);
      for (int half = 0; half < 2; ++half) store(sum.cosine[half] + sum.sine[half], y + k * pitch, half);
    }
  }

  Boundary boundary_;
  std::size_t cells_;
  Fft fft_;
  std::vector<T> sine_;
  std::vector<T> cosine_;
};

}  // namespace cambium::detail
