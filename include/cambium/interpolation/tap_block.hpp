// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
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
    if (count < lanes) return locate_few(x, count, row);
    // Copies: members and arguments would be read again after every store.
    const std::array<AxisLocator<K, P>, D> axis = axis_;
    const std::array<const P*, D> at = x;
    std::array<Lanes, D> middle_of_row;
    for (int d = 0; d < D; ++d) middle_of_row[d] = Lanes(static_cast<P>(row[d]) + P(0.5));
    const auto known = [&](int d, std::size_t i) { return axis[d].reduce(Lanes::load(at[d] + i)) - middle_of_row[d]; };
    const Lanes node_lanes(static_cast<P>(tap_lanes<K>));
    const Lanes first_column(static_cast<P>(-row[0]) * static_cast<P>(tap_lanes<K>));
    // One loop over all axes, whose end the processor mispredicts once. The last vector may overlap the one before.
    for (std::size_t i = 0;; i = std::min(i + lanes, count - lanes)) {
      const Lanes u = axis[0].reduce(Lanes::load(at[0] + i));
      const Lanes c = axis[0].cell(u);
      weigh(u - c - Lanes(P(0.5)), fast + slack, i);
      if constexpr (D > 2) weigh(known(1, i), middle, i);
      if constexpr (D > 1) convert(known(D - 1, i)).store(offset + i);
      alignas(64) P column[lanes];
      fma(c, node_lanes, first_column).store_aligned(column);
      for (std::size_t l = 0; l < lanes; ++l) cell[i + l] = static_cast<std::int32_t>(column[l]);
      if (i + lanes >= count) break;
    }
  }

  alignas(64) T fast[support + 2 * slack][capacity]{};
  alignas(64) T middle[D > 2 ? support : 1][capacity]{};
  alignas(64) T offset[capacity]{};
  alignas(64) std::int32_t cell[capacity]{};

 private:
  using Lanes = simd::Pack<P, lanes>;

  using Weights = simd::Pack<T, lanes>;

  /// Fewer particles than lanes: the first one fills the others.
  void locate_few(const std::array<const P*, D>& x, std::size_t count, const Index<D>& row) {
    P few[D][lanes];
    std::array<const P*, D> filled;
    for (int d = 0; d < D; ++d) {
      for (std::size_t l = 0; l < lanes; ++l) few[d][l] = x[d][l < count ? l : 0];
      filled[d] = few[d];
    }
    locate(filled, lanes, row);
  }
  [[gnu::always_inline]] static Weights convert(const Lanes& values) {
    if constexpr (std::is_same_v<T, P>) {
      return values;
    } else {
      alignas(64) P from[lanes];
      alignas(64) T to[lanes];
      values.store_aligned(from);
      for (std::size_t l = 0; l < lanes; ++l) to[l] = static_cast<T>(from[l]);
      return Weights::load_aligned(to);
    }
  }
  /// Weights of all taps of particles i, ..., i + lanes - 1 at the offsets g.
  [[gnu::always_inline]] static void weigh(const Lanes& g, T (*weight)[capacity], std::size_t i) {
    const Weights at = convert(g);
    if constexpr (Taps<K>::polynomial) {
      if constexpr (Taps<K>::symmetric) {
        weigh_symmetric(at, weight, i);
      } else {
        for (std::size_t k = 0; k < support; ++k) horner<0, 1>(at, k).store(weight[k] + i);
      }
    } else {
      alignas(64) T offset_of[lanes];
      at.store_aligned(offset_of);
      for (std::size_t l = 0; l < lanes; ++l) {
        T w[support];
        Taps<K>::weights(offset_of[l], w);
        for (std::size_t k = 0; k < support; ++k) weight[k][i + l] = w[k];
      }
    }
  }

  /// Tap k is even(g^2) + g odd(g^2), its mirror image even(g^2) - g odd(g^2).
  [[gnu::always_inline]] static void weigh_symmetric(const Weights& g, T (*weight)[capacity], std::size_t i) {
    const Weights g2 = g * g;
    for (std::size_t k = 0; k < support / 2; ++k) {
      const Weights even = horner<0, 2>(g2, k);
      const Weights odd = g * horner<1, 2>(g2, k);
      (even + odd).store(weight[k] + i);
      (even - odd).store(weight[support - 1 - k] + i);
    }
    if constexpr (support % 2 == 1) horner<0, 2>(g2, support / 2).store(weight[support / 2] + i);
  }
  /// Polynomial with the coefficients First, First + Step, First + 2 Step, ... of tap k.
  template <int First, int Step>
  [[gnu::always_inline]] static Weights horner(const Weights& at, std::size_t k) {
    constexpr int highest = Taps<K>::degree - (Taps<K>::degree - First) % Step;
    const auto coefficient = [k](int j) { return Weights(static_cast<T>(Taps<K>::coefficients.value[j][k])); };
    Weights sum = coefficient(highest);
    for (int j = highest - Step; j >= First; j -= Step) sum = fma(sum, at, coefficient(j));
    return sum;
  }

  std::array<AxisLocator<K, P>, D> axis_;
};

}  // namespace cambium::detail
