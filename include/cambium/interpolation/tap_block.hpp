// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <cambium/interpolation/axis.hpp>
#include <cambium/simd/pack.hpp>

namespace cambium::detail {

/// Number of lanes that hold the taps of one axis: the power of two from the support up, at least 4.
template <class K>
inline constexpr std::size_t tap_lanes = K::support <= 4   ? 4
                                         : K::support <= 8 ? 8
                                                           : 16;

/// True if two neighbouring nodes of a window, tap_lanes each, fit one hardware vector: columns are then worked on in
/// pairs, unaligned, which halves the number of instructions.
template <class K, class T>
inline constexpr bool columns_in_pairs = 2 * tap_lanes<K> <= simd::native_lanes<T>;

/// Taps of one axis as one pack, tap k in lane (rotation + k) mod tap_lanes, by Horner's rule across the lanes; with
/// Repeat = 2, the same taps twice.
template <class K, class T, std::size_t Repeat = 1>
class RotatedTaps {
 public:
  static constexpr std::size_t lanes = tap_lanes<K>;
  using Lanes = simd::Pack<T, Repeat * lanes>;

  void rotate(std::size_t rotation) {
    rotation_ = rotation % lanes;
    if constexpr (Taps<K>::polynomial) {
      for (auto& row : coefficient_) row.fill(T(0));
      for (std::size_t j = 0; j < coefficient_.size(); ++j) {
        for (std::size_t k = 0; k < K::support; ++k) {
          for (std::size_t r = 0; r < Repeat; ++r) {
            coefficient_[j][r * lanes + (rotation_ + k) % lanes] = static_cast<T>(Taps<K>::coefficients.value[j][k]);
          }
        }
      }
    }
  }
  [[gnu::always_inline]] Lanes operator()(T g) const {
    if constexpr (Taps<K>::polynomial) {
      const Lanes at(g);
      Lanes sum = Lanes::load_aligned(coefficient_.back().data());
      for (int j = Taps<K>::degree - 1; j >= 0; --j) {
        sum = fma(sum, at, Lanes::load_aligned(coefficient_[static_cast<std::size_t>(j)].data()));
      }
      return sum;
    } else {
      T weight[K::support];
      Taps<K>::weights(g, weight);
      alignas(64) T rotated[Repeat * lanes] = {};
      for (std::size_t k = 0; k < K::support; ++k) {
        for (std::size_t r = 0; r < Repeat; ++r) rotated[r * lanes + (rotation_ + k) % lanes] = weight[k];
      }
      return Lanes::load_aligned(rotated);
    }
  }

 private:
  static constexpr std::size_t rows = Taps<K>::polynomial ? Taps<K>::degree + 1 : 1;
  std::size_t rotation_ = 0;
  alignas(64) std::array<std::array<T, Repeat * lanes>, rows> coefficient_{};
};

/// The taps of the last axis in the form that Spread and Collect take.
template <class K, class T>
using LastTaps = RotatedTaps<K, T, columns_in_pairs<K, T> ? 2 : 1>;

/// Stencils of up to 64 particles of one row of cells, found lane by lane over the particles.
///
/// fast[k][i] is the weight of tap k of particle i along axis 0, with `slack` rows of zeros before and behind; middle
/// likewise along axis 1 (in 3D); offset[i] the offset along the last axis; cell[i] the cell along axis 0 times the
/// lanes of the window.
template <class K, class T, class P, int D>
class TapBlock {
 public:
  static constexpr std::size_t capacity = 64;
  static constexpr std::size_t lanes = simd::native_lanes<P>;
  static constexpr std::size_t slack = 2;
  static constexpr std::size_t support = K::support;

  explicit TapBlock(const Lattice<D>& lattice) {
    for (int d = 0; d < D; ++d) axis_[d] = AxisLocator<K, P>(lattice, d);
  }

  /// \param x     positions of the block's particles, one pointer for each axis
  /// \param count number of particles, at most 64
  /// \param row   cell of all of them along axes 1, ..., D - 1; along axis 0, the cell that counts as 0
  void locate(const std::array<const P*, D>& x, std::size_t count, const Index<D>& row) {
    const std::size_t padded = (count + lanes - 1) / lanes * lanes;
    const AxisLocator<K, P> axis = axis_[0];  // a copy: members would be read again after every store
    alignas(64) P scratch[capacity];
    for (std::size_t i = 0; i < padded; i += lanes) {
      const Lanes u = axis.reduce(load(x[0], i, count));
      const Lanes c = axis.cell(u);
      store(u - c - Lanes(P(0.5)), first_ + i);
      c.store_aligned(scratch + i);
    }
    const auto shift = static_cast<std::int32_t>(row[0]);
    for (std::size_t i = 0; i < padded; ++i) {
      cell[i] = (static_cast<std::int32_t>(scratch[i]) - shift) * static_cast<std::int32_t>(tap_lanes<K>);
    }
    weigh(first_, fast + slack, padded);
    if constexpr (D > 1) locate_known(D - 1, x[D - 1], count, row[D - 1], offset);
    if constexpr (D > 2) {
      locate_known(1, x[1], count, row[1], first_);
      weigh(first_, middle, padded);
    }
  }

  alignas(64) T fast[support + 2 * slack][capacity]{};
  alignas(64) T middle[D > 2 ? support : 1][capacity]{};
  alignas(64) T offset[capacity]{};
  alignas(64) std::int32_t cell[capacity]{};

 private:
  using Lanes = simd::Pack<P, lanes>;

  [[gnu::always_inline]] static Lanes load(const P* x, std::size_t i, std::size_t count) {
    if (i + lanes <= count) return Lanes::load(x + i);
    P buffer[lanes];
    for (std::size_t l = 0; l < lanes; ++l) buffer[l] = x[i + l < count ? i + l : i];
    return Lanes::load(buffer);
  }
  [[gnu::always_inline]] static void store(const Lanes& values, T* to) {
    if constexpr (std::is_same_v<T, P>) {
      values.store_aligned(to);
    } else {
      alignas(64) P buffer[lanes];
      values.store_aligned(buffer);
      for (std::size_t l = 0; l < lanes; ++l) to[l] = static_cast<T>(buffer[l]);
    }
  }
  /// Offsets along an axis on which the cell is known.
  [[gnu::always_inline]] void locate_known(int d, const P* x, std::size_t count, std::ptrdiff_t cell_of_row,
                                           T* g) const {
    const AxisLocator<K, P> axis = axis_[d];
    const Lanes middle_of_cell(static_cast<P>(cell_of_row) + P(0.5));
    for (std::size_t i = 0; i < count; i += lanes) {
      store(axis.reduce(load(x, i, count)) - middle_of_cell, g + i);
    }
  }
  /// Weights of all taps at the offsets g.
  [[gnu::always_inline]] static void weigh(const T* g, T (*weight)[capacity], std::size_t padded) {
    if constexpr (Taps<K>::polynomial) {
      using V = simd::Pack<T, lanes>;
      for (std::size_t i = 0; i < padded; i += lanes) {
        const V at = V::load_aligned(g + i);
        for (std::size_t k = 0; k < support; ++k) {
          V sum(static_cast<T>(Taps<K>::coefficients.value[Taps<K>::degree][k]));
          for (int j = Taps<K>::degree - 1; j >= 0; --j) {
            sum = fma(sum, at, V(static_cast<T>(Taps<K>::coefficients.value[j][k])));
          }
          sum.store_aligned(weight[k] + i);
        }
      }
    } else {
      for (std::size_t i = 0; i < padded; ++i) {
        T w[support];
        Taps<K>::weights(g[i], w);
        for (std::size_t k = 0; k < support; ++k) weight[k][i] = w[k];
      }
    }
  }

  std::array<AxisLocator<K, P>, D> axis_;
  alignas(64) T first_[capacity]{};
};

}  // namespace cambium::detail
