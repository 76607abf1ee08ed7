// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/poisson/box_transform.hpp>
#include <cambium/poisson/padded_fft.hpp>

namespace cambium::detail {

/// Sums u(n) = sum_m K(|n - m|) f(m) over the nodes of a box, for a kernel K that is even along each axis.
///
/// Values are padded with zeros to twice the cells and transformed to complex waves, on which a real even kernel acts
/// by one real number for each. Transforms are pruned: lines known to be zero, or not wanted, are not transformed,
/// padding is never touched (PaddedFft), and the last axis is transformed, multiplied and transformed back while it is
/// in the cache. Along axis 0 two real lines make one complex line, and are told apart afterwards.
template <int D, class T, Execution E>
class EvenConvolution {
 public:
  using Line = LineTransform<T>;
  static constexpr std::size_t lines = Line::lines;
  static constexpr std::size_t width = Line::width;
  static constexpr int last = D - 1;

  /// \param kernel  K at offsets 0, ..., cells along each axis, axis 0 fastest
  EvenConvolution(const Index<D>& cells, const AlignedVector<double>& kernel, const E& execution)
      : execution_(execution), cells_(cells) {
    std::size_t work = padded_nodes() * lines;
    for (int d = 0; d < D; ++d) {
      padded_.emplace_back(static_cast<std::size_t>(cells[d]));
      work = std::max(work, padded_.back().half_size());
    }
    blocks_ = static_cast<std::size_t>(cells[0]) / width + 1;
    row_pitch_ = blocks_ * lines + width;
    plane_pitch_ = (nodes(1) + lines) * row_pitch_ + width;
    values_.resize(plane_pitch_ * (D == 3 ? nodes(last) : 1));
    tabulate(kernel);
    work_.resize(static_cast<std::size_t>(execution.count()));
    for (auto& arrays : work_) {
      for (std::size_t a = 0; a < 4; ++a) arrays[a].resize(work);
      if (D == 3) arrays[4].resize(nodes(last) * slab_pitch());
    }
  }

  /// read(i, j, k, x) fills x[0, nodes) with f of the row along axis 0 at (j, k); write(j, k, x) takes u from there.
  template <class Read, class Write>
  void operator()(Read&& read, Write&& write) {
    const auto& fft = padded_.front();
    for_each_row_tile([&](std::size_t j, std::size_t k, Work& work) {
      read_rows(j, k, work, read);
      for (int parity = 0; parity < 2; ++parity) {
        T* const half = work[parity == 0 ? 0 : 2].data();
        fft.forward(parity, work[3].data(), lines, half, work[1].data());
      }
      store_waves(j, k, work);
    });
    for_each_piece_by_worker(execution_, blocks_, 1,
                             [&](std::size_t worker, std::size_t b, std::size_t) { convolve_block(b, work_[worker]); });
    for_each_row_tile([&](std::size_t j, std::size_t k, Work& work) {
      load_waves(j, k, work);
      const T* const even = fft.backward(work[0].data(), work[1].data());
      T* const rest = even == work[0].data() ? work[1].data() : work[0].data();
      fft.join(even, fft.backward(work[2].data(), rest), work[3].data(), lines, true);
      write_rows(j, k, work, write);
    });
  }

 private:
  using Work = std::array<AlignedVector<T>, 5>;

  std::size_t nodes(int d) const { return static_cast<std::size_t>(cells_[d]) + 1; }
  std::size_t waves(int d) const { return 2 * static_cast<std::size_t>(cells_[d]); }
  std::size_t slab_pitch() const { return waves(1) * lines + width; }
  T* row(std::size_t j, std::size_t k) { return values_.data() + k * plane_pitch_ + j * row_pitch_; }

  /// The kernel's cosine transform over the norm of the transforms, in the order in which convolve_block() wants it.
  void tabulate(const AlignedVector<double>& kernel) {
    std::array<Boundary, D> even;
    even.fill(Boundary::neumann);
    BoxTransform<D, double, E> transform(even, cells_, execution_);
    const auto count = static_cast<std::ptrdiff_t>(nodes(0));
    double scale = 1.0;
    for (int d = 0; d < D; ++d) scale *= 2.0 / static_cast<double>(waves(d));
    transform.to_waves([&](const Index<D>& m, double* values) {
      std::ptrdiff_t number = m[last];
      for (int d = D - 2; d >= 0; --d) number = number * static_cast<std::ptrdiff_t>(nodes(d)) + m[d];
      for (std::ptrdiff_t i = 0; i < count; ++i) values[i] = scale * kernel[static_cast<std::size_t>(number + i)];
    });
    const std::size_t across = D == 3 ? nodes(1) : 1;
    symbol_.resize(blocks_ * across * nodes(last) * width);
    transform.change_waves([&](const Index<D>& m, const double* tile) {
      for (std::size_t k = 0; k < nodes(last); ++k) {
        for (std::size_t i = 0; i < transform.lines; ++i) {
          const std::size_t wave = static_cast<std::size_t>(m[0]) + i;
          if (wave / width >= blocks_) continue;
          const std::size_t j = D == 3 ? static_cast<std::size_t>(m[1]) : 0;
          const double value = wave < nodes(0) ? tile[k * transform.lines + i] : 0.0;
          symbol_[((wave / width * across + j) * nodes(last) + k) * width + wave % width] = static_cast<T>(value);
        }
      }
    });
  }

  /// Calls f(j, k, work) for every `lines` rows (j, k), (j + 1, k), ...
  template <class F>
  void for_each_row_tile(F&& f) {
    const std::size_t tiles = (nodes(1) + lines - 1) / lines;
    for_each_piece_by_worker(execution_, tiles * (D == 3 ? nodes(last) : 1), 8,
                             [&](std::size_t worker, std::size_t begin, std::size_t end) {
                               for (std::size_t t = begin; t < end; ++t) f(t % tiles * lines, t / tiles, work_[worker]);
                             });
  }

  template <class Read>
  void read_rows(std::size_t j, std::size_t k, Work& work, Read&& read) {
    const std::size_t pitch = padded_nodes();
    T* const rows = work[0].data();
    for (std::size_t r = 0; r < lines; ++r) {
      T* const to = rows + r * pitch;
      if (j + r < nodes(1)) {
        read(j + r, k, to);
      } else {
        std::fill(to, to + nodes(0), T(0));
      }
    }
    for (std::size_t i = 0; i < pitch; i += width) {
      for (std::size_t r = 0; r < lines; r += width) {
        simd::transpose<width>(rows + r * pitch + i, static_cast<std::ptrdiff_t>(pitch), work[3].data() + i * lines + r,
                               static_cast<std::ptrdiff_t>(lines));
      }
    }
  }
  template <class Write>
  void write_rows(std::size_t j, std::size_t k, Work& work, Write&& write) {
    const std::size_t pitch = padded_nodes();
    T* const rows = work[0].data();
    for (std::size_t i = 0; i < pitch; i += width) {
      for (std::size_t r = 0; r < lines; r += width) {
        simd::transpose<width>(work[3].data() + i * lines + r, static_cast<std::ptrdiff_t>(lines), rows + r * pitch + i,
                               static_cast<std::ptrdiff_t>(pitch));
      }
    }
    for (std::size_t r = 0; r < lines && j + r < nodes(1); ++r) write(j + r, k, rows + r * pitch);
  }
  std::size_t padded_nodes() const { return (nodes(0) + width - 1) / width * width; }

  /// A row of the array that holds the waves w of two halves of lines as z = x + i y.
  T* wave_row(std::size_t w, Work& work) const { return work[w % 2 == 0 ? 0 : 2].data() + w / 2 * lines; }
  /// Real parts of the waves of all lines to the lower half of each block, imaginary parts to the upper: from waves of
  /// pairs of lines, x_w = (z_w + conj z_(2n-w)) / 2 and y_w = (z_w - conj z_(2n-w)) / (2 i).
  void store_waves(std::size_t j, std::size_t k, Work& work) {
    using Lanes = typename Line::Lanes;
    alignas(64) std::array<T, width * lines> re{}, im{};
    const Lanes half(T(0.5));
    for (std::size_t b = 0; b < blocks_; ++b) {
      for (std::size_t i = 0; i < width; ++i) {
        const std::size_t w = b * width + i;
        T* const to_re = re.data() + i * lines;
        T* const to_im = im.data() + i * lines;
        if (w >= nodes(0)) {
          std::fill(to_re, to_re + lines, T(0));
          std::fill(to_im, to_im + lines, T(0));
          continue;
        }
        const T* const z = wave_row(w, work);
        const T* const mirror = wave_row(w == 0 ? 0 : waves(0) - w, work);
        const Lanes z_re = Lanes::load_aligned(z), z_im = Lanes::load_aligned(z + width);
        const Lanes m_re = Lanes::load_aligned(mirror), m_im = Lanes::load_aligned(mirror + width);
        (half * (z_re + m_re)).store_aligned(to_re);
        (half * (z_im + m_im)).store_aligned(to_re + width);
        (half * (z_im - m_im)).store_aligned(to_im);
        (half * (m_re - z_re)).store_aligned(to_im + width);
      }
      T* const to = row(j, k) + b * lines;
      for (std::size_t r = 0; r < lines; r += width) {
        simd::transpose<width>(re.data() + r, pitch_of(lines), to + r * row_pitch_, pitch_of(row_pitch_));
        simd::transpose<width>(im.data() + r, pitch_of(lines), to + r * row_pitch_ + width, pitch_of(row_pitch_));
      }
    }
  }
  /// The way back, with real and imaginary parts of z exchanged.
  void load_waves(std::size_t j, std::size_t k, Work& work) {
    using Lanes = typename Line::Lanes;
    alignas(64) std::array<T, width * lines> re, im;
    for (std::size_t b = 0; b < blocks_; ++b) {
      const T* const from = row(j, k) + b * lines;
      for (std::size_t r = 0; r < lines; r += width) {
        simd::transpose<width>(from + r * row_pitch_, pitch_of(row_pitch_), re.data() + r, pitch_of(lines));
        simd::transpose<width>(from + r * row_pitch_ + width, pitch_of(row_pitch_), im.data() + r, pitch_of(lines));
      }
      for (std::size_t w = b * width; w < std::min((b + 1) * width, nodes(0)); ++w) {
        const T* const at_re = re.data() + w % width * lines;
        const T* const at_im = im.data() + w % width * lines;
        const Lanes x_re = Lanes::load_aligned(at_re), y_re = Lanes::load_aligned(at_re + width);
        const Lanes x_im = Lanes::load_aligned(at_im), y_im = Lanes::load_aligned(at_im + width);
        T* const mirror = wave_row(w == 0 ? 0 : waves(0) - w, work);
        (y_re - x_im).store_aligned(mirror);
        (x_re + y_im).store_aligned(mirror + width);
        T* const z = wave_row(w, work);
        (x_im + y_re).store_aligned(z);
        (x_re - y_im).store_aligned(z + width);
      }
    }
  }
  static std::ptrdiff_t pitch_of(std::size_t n) { return static_cast<std::ptrdiff_t>(n); }

  void convolve_block(std::size_t b, Work& work) {
    T* const values = row(0, 0) + b * lines;
    const T* const symbol = symbol_.data() + b * (D == 3 ? nodes(1) : 1) * nodes(last) * width;
    if constexpr (D == 2) {
      multiply(values, row_pitch_, symbol, work, true);
    } else {
      const auto& fft = padded_[1];
      T* const slab = work[4].data();
      for (std::size_t k = 0; k < nodes(2); ++k) {
        for (int parity = 0; parity < 2; ++parity) {
          T* const waves = slab + k * slab_pitch() + (parity == 0 ? 0 : fft.half_size());
          fft.forward(parity, values + k * plane_pitch_, row_pitch_, waves, work[0].data());
        }
      }
      for (std::size_t j = 0; j < waves(1); ++j) {
        const std::size_t wave = mirrored(1, j < waves(1) / 2 ? 2 * j : 2 * j - waves(1) + 1);
        multiply(slab + j * lines, slab_pitch(), symbol + wave * nodes(2) * width, work, false);
      }
      for (std::size_t k = 0; k < nodes(2); ++k) {
        T* const even = slab + k * slab_pitch();
        const T* const first = fft.backward(even, work[0].data());
        const T* const second = fft.backward(even + fft.half_size(), work[1].data());
        fft.join(first, second, values + k * plane_pitch_, row_pitch_, true);
      }
    }
  }
  std::size_t mirrored(int axis, std::size_t wave) const { return std::min(wave, waves(axis) - wave); }

  /// Along the last axis: to waves, times the symbol, and back with real and imaginary parts exchanged or restored.
  void multiply(T* values, std::size_t pitch, const T* symbol, Work& work, bool restore) {
    using Lanes = typename Line::Lanes;
    const auto& fft = padded_.back();
    std::array<const T*, 2> result;
    for (int parity = 0; parity < 2; ++parity) {
      T* const half = work[parity == 0 ? 0 : 2].data();
      T* const other = work[parity == 0 ? 1 : 3].data();
      fft.forward(parity, values, pitch, half, other);
      for (std::size_t k = 0; k < fft.cells(); ++k) {
        const std::size_t wave = mirrored(last, 2 * k + (parity == 0 ? 0 : 1));
        const Lanes factor = Lanes::load_aligned(symbol + wave * width);
        T* const row = half + k * lines;
        const Lanes re = factor * Lanes::load_aligned(row), im = factor * Lanes::load_aligned(row + width);
        im.store_aligned(row);
        re.store_aligned(row + width);
      }
      result[parity == 0 ? 0 : 1] = fft.backward(half, other);
    }
    fft.join(result[0], result[1], values, pitch, restore);
  }

  E execution_;
  Index<D> cells_;
  std::vector<PaddedFft<T>> padded_;  ///< along each axis
  std::size_t blocks_ = 0;
  std::size_t row_pitch_ = 0;
  std::size_t plane_pitch_ = 0;
  AlignedVector<T> values_;
  AlignedVector<T> symbol_;
  std::vector<Work> work_;
};

}  // namespace cambium::detail
