// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <cambium/core/aligned.hpp>
#include <cambium/interpolation/tap_block.hpp>

namespace cambium::detail {

/// The moving window of a sweep along the last axis (2D and 3D), for C components.
///
/// The nodes of the plane being worked on are vectors in scratch: lane (p mod lanes) holds the node in plane p of the
/// box, counted from its first padded plane. So the taps of the last axis are one aligned vector, no load or store is
/// ever misaligned, and a plane that is complete is one lane of the scratch. Rows are padded by support - 1 nodes, and
/// their pitch keeps the rows of one stencil from sharing address bits 0 to 11 (4 KiB aliasing).
template <class K, class T, int D, int C>
class Window {
 public:
  static_assert(D == 2 || D == 3);
  static constexpr std::size_t lanes = tap_lanes<K>;
  static constexpr std::size_t support = K::support;
  using Lanes = simd::Pack<T, lanes>;

  /// Makes the window for a box of cells, all nodes zero; allocates only if it grows.
  void reset(const Index<D>& cells) {
    columns_ = static_cast<std::size_t>(cells[0]) + support - 1;
    rows_ = D == 2 ? 1 : static_cast<std::size_t>(cells[1]) + support - 1;
    pitch_ = padded_pitch(columns_);
    // Some nodes more: a pair of columns, or a vector of several nodes, may reach beyond the last row.
    const std::size_t size = (C * rows_ * pitch_ + 16) * lanes;
    if (nodes_.size() < size) nodes_.resize(size);
    std::fill_n(nodes_.begin(), size, T(0));
  }

  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  std::size_t pitch() const { return pitch_; }
  /// First node of a padded row of component c.
  T* row(int c, std::size_t r) { return nodes_.data() + (static_cast<std::size_t>(c) * rows_ + r) * pitch_ * lanes; }

 private:
  static std::size_t padded_pitch(std::size_t columns) {
    constexpr std::size_t node = lanes * sizeof(T);
    for (std::size_t pitch = columns;; ++pitch) {
      bool apart = true;
      for (std::size_t j = 1; j < support; ++j) {
        const std::size_t low = pitch * node * j % 4096;
        apart &= std::min(low, 4096 - low) >= support * node || D == 2;
      }
      if (apart || pitch > columns + 64) return pitch;
    }
  }

  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::size_t pitch_ = 0;
  AlignedVector<T> nodes_;
};

/// Adds the strengths of a block of particles to the window: node += strength w(fast) w(middle) w(last).
///
/// Where a node fills a hardware vector, the stores bound the loop: two neighbours whose stencils differ by at most one
/// column go together, with one column more and half of the stores. Where a node fills half a vector, columns go in
/// pairs; such stores overlap those of the neighbours misaligned, and a load from two stores under way would stall, so
/// that particles are visited eight apart.
template <class K, class T, class P, int D, int C>
class Spread {
 public:
  using Block = TapBlock<K, T, P, D>;

  Spread(const Block& block, const LastTaps<K, T>& last, std::ptrdiff_t pitch)
      : block_(block), last_(last), pitch_(pitch * static_cast<std::ptrdiff_t>(lanes)) {}

  /// \param strength  one pointer for each component, at the block's first particle
  /// \param row       first stencil row of each component in the window
  void operator()(const std::array<const T*, C>& strength, std::size_t count, const std::array<T*, C>& row) const {
    if constexpr (columns_in_pairs<K, T>) {
      for (std::size_t start = 0; start < apart; ++start) {
        for (std::size_t i = start; i < count; i += apart) add<1>(i, strength, row);
      }
      return;
    }
    std::size_t i = 0;
    while (support > 4 && i + 1 < count) {
      const std::int32_t gap = block_.cell[i + 1] - block_.cell[i];
      if (gap >= 0 && gap <= static_cast<std::int32_t>(lanes)) {
        add<2>(i, strength, row);
        i += 2;
      } else {
        add<1>(i, strength, row);
        ++i;
      }
    }
    for (; i < count; ++i) add<1>(i, strength, row);
  }

 private:
  using Lanes = typename LastTaps<K, T>::Lanes;
  static constexpr std::size_t lanes = tap_lanes<K>;
  static constexpr std::size_t support = K::support;
  static constexpr std::size_t middle_taps = D == 3 ? support : 1;
  static constexpr std::size_t apart = 8;
  static constexpr std::size_t step = columns_in_pairs<K, T> ? 2 : 1;
  static constexpr auto capacity = static_cast<std::ptrdiff_t>(Block::capacity);

  /// Particles i, ..., i + N - 1, whose first columns are those of particle i or one further.
  template <std::size_t N>
  [[gnu::always_inline]] void add(std::size_t i, const std::array<const T*, C>& strength,
                                  const std::array<T*, C>& row) const {
    constexpr std::size_t columns = support + N - 1;
    Lanes slow[N];
    Lanes middle[N][middle_taps];
    const T* fast[N];
    for (std::size_t n = 0; n < N; ++n) {
      slow[n] = last_(block_.offset[i + n]);
      // One column further: the taps, too, are one place further, and a zero comes first. No branch: it would be a
      // coin.
      const std::ptrdiff_t further = block_.cell[i + n] != block_.cell[i];
      fast[n] = block_.fast[Block::slack] + static_cast<std::ptrdiff_t>(i + n) - further * capacity;
      if constexpr (D == 3) {
        for (std::size_t j = 0; j < support; ++j) middle[n][j] = Lanes(block_.middle[j][i + n]);
      }
    }
    const std::ptrdiff_t pitch = pitch_;  // a member would be read again after every store
    for (int c = 0; c < C; ++c) {
      Lanes scaled[N];
      for (std::size_t n = 0; n < N; ++n) scaled[n] = slow[n] * Lanes(strength[c][i + n]);
      T* column = row[c] + block_.cell[i];
      for (std::size_t k = 0; k < columns; k += step, column += step * lanes) {
        Lanes along[N];
        for (std::size_t n = 0; n < N; ++n) along[n] = scaled[n] * columns_at(fast[n] + k * Block::capacity);
        add_column<N>(along, middle, column, pitch);
      }
    }
  }
  /// Weight of one column in all lanes, or of two in half of the lanes each.
  [[gnu::always_inline]] static Lanes columns_at(const T* fast) {
    if constexpr (step == 2) {
      return Lanes::halves(fast[0], fast[capacity]);
    } else {
      return Lanes(fast[0]);
    }
  }
  template <std::size_t N>
  [[gnu::always_inline]] static void add_column(const Lanes (&along)[N], const Lanes (&middle)[N][middle_taps], T* node,
                                                std::ptrdiff_t pitch) {
    for (std::size_t j = 0; j < middle_taps; ++j) {
      Lanes sum = load(node);
      for (std::size_t n = 0; n < N; ++n) {
        if constexpr (D == 3) {
          sum = fma(along[n], middle[n][j], sum);
        } else {
          sum = sum + along[n];
        }
      }
      if constexpr (step == 2) {
        sum.store(node);
      } else {
        sum.store_aligned(node);
      }
      node = simd::keep_in_register(node + pitch);
    }
  }
  [[gnu::always_inline]] static Lanes load(const T* node) {
    return step == 2 ? Lanes::load(node) : Lanes::load_aligned(node);
  }

  const Block& block_;
  const LastTaps<K, T>& last_;
  std::ptrdiff_t pitch_;
};

/// Reads the window at a block of particles: value = sum of node w(fast) w(middle) w(last).
template <class K, class T, class P, int D, int C>
class Collect {
 public:
  using Block = TapBlock<K, T, P, D>;

  Collect(const Block& block, const LastTaps<K, T>& last, std::ptrdiff_t pitch)
      : block_(block), last_(last), pitch_(pitch * static_cast<std::ptrdiff_t>(lanes)) {}

  void operator()(const std::array<T*, C>& value, std::size_t count, const std::array<const T*, C>& row) const {
    for (std::size_t i = 0; i < count; ++i) {
      const Lanes slow = last_(block_.offset[i]);
      Lanes fast[groups];
      for (std::size_t k = 0; k < groups; ++k) {
        const T* weight = &block_.fast[Block::slack + k * step][i];
        if constexpr (step == 2) {
          fast[k] = Lanes::halves(weight[0], weight[Block::capacity]);
        } else {
          fast[k] = Lanes(weight[0]);
        }
      }
      for (int c = 0; c < C; ++c) value[c][i] = sum(slow * plane(fast, i, row[c] + block_.cell[i]));
    }
  }

 private:
  using Lanes = typename LastTaps<K, T>::Lanes;
  static constexpr std::size_t lanes = tap_lanes<K>;
  static constexpr std::size_t support = K::support;
  static constexpr std::size_t step = columns_in_pairs<K, T> ? 2 : 1;
  /// Columns, or pairs of columns, of a stencil; the last pair of an odd support has a column of weight zero.
  static constexpr std::size_t groups = (support + step - 1) / step;

  [[gnu::always_inline]] Lanes plane(const Lanes (&fast)[groups], std::size_t i, const T* node) const {
    if constexpr (D == 2) return line(fast, node);
    const std::ptrdiff_t pitch = pitch_;
    Lanes total(T(0));
    for (std::size_t j = 0; j < support; ++j) {
      total = fma(line(fast, node), Lanes(block_.middle[j][i]), total);
      node = simd::keep_in_register(node + pitch);
    }
    return total;
  }
  [[gnu::always_inline]] static Lanes line(const Lanes (&fast)[groups], const T* node) {
    Lanes total = load(node) * fast[0];
    for (std::size_t k = 1; k < groups; ++k) total = fma(load(node + k * step * lanes), fast[k], total);
    return total;
  }
  [[gnu::always_inline]] static Lanes load(const T* node) {
    return step == 2 ? Lanes::load(node) : Lanes::load_aligned(node);
  }

  const Block& block_;
  const LastTaps<K, T>& last_;
  std::ptrdiff_t pitch_;
};

}  // namespace cambium::detail
