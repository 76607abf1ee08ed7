// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/poisson/box_transform.hpp>

namespace cambium::detail {

/// Sums u(n) = sum_m K(|n - m|) f(m) over the nodes of a box, for a kernel K that is even along each axis.
///
/// Values are padded with zeros to twice the cells and transformed by Hartley's waves, on which an even kernel acts by
/// one real number for each: no complex data anywhere. Transforms are pruned: lines known to be zero, or not wanted,
/// are not transformed, and the last axis is transformed, multiplied and transformed back while it is in the cache.
/// Along axis 0 the waves k and 2 n - k, on which the kernel acts alike, are stored in the two halves of a tile row.
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
    std::size_t work = 0;
    for (int d = 0; d < D; ++d) {
      line_.emplace_back(Boundary::periodic, 2 * static_cast<std::size_t>(cells[d]));
      work = std::max(work, line_.back().size() * lines);
    }
    work = std::max(work, padded_nodes() * lines);
    blocks_ = static_cast<std::size_t>(cells[0]) / width + 1;
    row_pitch_ = blocks_ * lines + width;
    plane_pitch_ = (nodes(1) + lines) * row_pitch_ + width;
    values_.resize(plane_pitch_ * (D == 3 ? nodes(last) : 1));
    tabulate(kernel);
    work_.resize(static_cast<std::size_t>(execution.count()));
    for (auto& arrays : work_) {
      for (int a = 0; a < 3; ++a) arrays[static_cast<std::size_t>(a)].resize(work);
      if (D == 3) arrays[3].resize(nodes(last) * slab_pitch());
    }
  }

  /// read(i, j, k, x) fills x[0, nodes) with f of the row along axis 0 at (j, k); write(j, k, x) takes u from there.
  template <class Read, class Write>
  void operator()(Read&& read, Write&& write) {
    for_each_row_tile([&](std::size_t j, std::size_t k, auto& work) {
      read_rows(j, k, work, read);
      line_[0].run(work[2].data(), lines, nodes(0), work[2].data(), lines, line_[0].size(), work[0].data(),
                   work[1].data());
      store_waves(j, k, work[2].data());
    });
    for_each_piece_by_worker(execution_, blocks_, 1,
                             [&](std::size_t worker, std::size_t b, std::size_t) { convolve_block(b, work_[worker]); });
    for_each_row_tile([&](std::size_t j, std::size_t k, auto& work) {
      load_waves(j, k, work[2].data());
      line_[0].run(work[2].data(), lines, line_[0].size(), work[2].data(), lines, nodes(0), work[0].data(),
                   work[1].data());
      write_rows(j, k, work, write);
    });
  }

 private:
  using Work = std::array<AlignedVector<T>, 4>;

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
    transform.clear_margins();
    transform.for_each_row([&](const Index<D>& m, double* values) {
      std::ptrdiff_t number = m[last];
      for (int d = D - 2; d >= 0; --d) number = number * static_cast<std::ptrdiff_t>(nodes(d)) + m[d];
      for (std::ptrdiff_t i = 0; i < count; ++i) values[i] = scale * kernel[static_cast<std::size_t>(number + i)];
    });
    transform.to_waves();
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
        simd::transpose<width>(rows + r * pitch + i, static_cast<std::ptrdiff_t>(pitch), work[2].data() + i * lines + r,
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
        simd::transpose<width>(work[2].data() + i * lines + r, static_cast<std::ptrdiff_t>(lines), rows + r * pitch + i,
                               static_cast<std::ptrdiff_t>(pitch));
      }
    }
    for (std::size_t r = 0; r < lines && j + r < nodes(1); ++r) write(j + r, k, rows + r * pitch);
  }
  std::size_t padded_nodes() const { return (nodes(0) + width - 1) / width * width; }

  /// Wave k of each line to the lower half of its block, 2 n - k to the upper.
  void store_waves(std::size_t j, std::size_t k, const T* tile) {
    const std::size_t n = line_[0].size();
    for (std::size_t b = 0; b < blocks_; ++b) {
      T* const to = row(j, k) + b * lines;
      if (whole(b)) {
        move_block(tile + b * width * lines, pitch_of(lines), to, pitch_of(row_pitch_));
        move_block(tile + (n - b * width) * lines, -pitch_of(lines), to + width, pitch_of(row_pitch_));
        continue;
      }
      for (std::size_t i = 0; i < width; ++i) {
        const std::size_t wave = (b * width + i) % n;
        for (std::size_t r = 0; r < lines; ++r) {
          to[r * row_pitch_ + i] = tile[wave * lines + r];
          to[r * row_pitch_ + width + i] = tile[(n - wave) % n * lines + r];
        }
      }
    }
  }
  void load_waves(std::size_t j, std::size_t k, T* tile) {
    const std::size_t n = line_[0].size();
    for (std::size_t b = 0; b < blocks_; ++b) {
      const T* const from = row(j, k) + b * lines;
      if (whole(b)) {
        for (std::size_t r = 0; r < lines; r += width) {
          T* const to = tile + b * width * lines + r;
          simd::transpose<width>(from + r * row_pitch_, pitch_of(row_pitch_), to, pitch_of(lines));
          simd::transpose<width>(from + r * row_pitch_ + width, pitch_of(row_pitch_),
                                 tile + (n - b * width) * lines + r, -pitch_of(lines));
        }
        continue;
      }
      for (std::size_t wave = b * width; wave < std::min((b + 1) * width, nodes(0)); ++wave) {
        for (std::size_t r = 0; r < lines; ++r) {
          tile[wave * lines + r] = from[r * row_pitch_ + wave % width];
          if (wave > 0) tile[(n - wave) * lines + r] = from[r * row_pitch_ + width + wave % width];
        }
      }
    }
  }
  /// True if the waves of a block and their mirror images are 2 `width` different ones.
  bool whole(std::size_t b) const { return b > 0 && (b + 1) * width < nodes(0); }
  static std::ptrdiff_t pitch_of(std::size_t n) { return static_cast<std::ptrdiff_t>(n); }
  static void move_block(const T* from, std::ptrdiff_t from_pitch, T* to, std::ptrdiff_t to_pitch) {
    for (std::size_t r = 0; r < lines; r += width, to += static_cast<std::ptrdiff_t>(width) * to_pitch) {
      simd::transpose<width>(from + r, from_pitch, to, to_pitch);
    }
  }

  void convolve_block(std::size_t b, Work& work) {
    T* const values = row(0, 0) + b * lines;
    const T* const symbol = symbol_.data() + b * (D == 3 ? nodes(1) : 1) * nodes(last) * width;
    if constexpr (D == 2) {
      multiply(values, row_pitch_, symbol, work);
    } else {
      T* const slab = work[3].data();
      for (std::size_t k = 0; k < nodes(2); ++k) {
        line_[1].run(values + k * plane_pitch_, row_pitch_, nodes(1), slab + k * slab_pitch(), lines, waves(1),
                     work[0].data(), work[1].data());
      }
      for (std::size_t j = 0; j < waves(1); ++j) {
        multiply(slab + j * lines, slab_pitch(), symbol + std::min(j, waves(1) - j) * nodes(2) * width, work);
      }
      for (std::size_t k = 0; k < nodes(2); ++k) {
        line_[1].run(slab + k * slab_pitch(), lines, waves(1), values + k * plane_pitch_, row_pitch_, nodes(1),
                     work[0].data(), work[1].data());
      }
    }
  }
  /// Along the last axis: to waves, times the symbol, back.
  void multiply(T* values, std::size_t pitch, const T* symbol, Work& work) {
    using Lanes = typename Line::Lanes;
    T* const tile = work[2].data();
    const std::size_t n = waves(last);
    line_.back().run(values, pitch, nodes(last), tile, lines, n, work[0].data(), work[1].data());
    for (std::size_t k = 0; k < n; ++k) {
      const Lanes factor = Lanes::load_aligned(symbol + std::min(k, n - k) * width);
      T* const row = tile + k * lines;
      (factor * Lanes::load_aligned(row)).store_aligned(row);
      (factor * Lanes::load_aligned(row + width)).store_aligned(row + width);
    }
    line_.back().run(tile, lines, n, values, pitch, nodes(last), work[0].data(), work[1].data());
  }

  E execution_;
  Index<D> cells_;
  std::vector<Line> line_;
  std::size_t blocks_ = 0;
  std::size_t row_pitch_ = 0;
  std::size_t plane_pitch_ = 0;
  AlignedVector<T> values_;
  AlignedVector<T> symbol_;
  std::vector<Work> work_;
};

}  // namespace cambium::detail
