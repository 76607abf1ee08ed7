// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <cambium/kernels/taps.hpp>
#include <cambium/levelset/jet.hpp>
#include <cambium/simd/pack.hpp>
#include <cambium/simd/transpose.hpp>

namespace cambium::detail {

/// Interpolation by kernel K at several places of one patch at a time: the taps of all axes are found for as
/// many places as a vector has lanes, and so is the last sum; those before run along the rows of one place.
template <class K, class T, int D>
class PlaceBatch {
 public:
  static_assert(K::support % 2 == 0, "cambium: places are interpolated by kernels of even support");
  static constexpr std::size_t lanes = TapJet<K, T>::lanes;
  static constexpr std::size_t places = std::max(simd::native_lanes<T>, lanes);

  /// \param place  the first of `count` <= places coordinates along each axis, readable up to `places` of them
  PlaceBatch(const std::array<const T*, D>& place, const Index<D>& stride) : stride_(stride) {
    Lanes first(T(0));
    for (int d = 0; d < D; ++d) {
      const Lanes u = Lanes::load(place[d]);
      const Lanes cell = floor(u);
      const Lanes g = u - cell - Lanes(T(0.5));
      first = fma(cell - Lanes(static_cast<T>(Taps<K>::before)), Lanes(static_cast<T>(stride[d])), first);
      for (int k = 0; k < K::support; ++k) {
        Lanes sum(coefficient(Taps<K>::degree, k));
        for (int j = Taps<K>::degree - 1; j >= 0; --j) sum = fma(sum, g, Lanes(coefficient(j, k)));
        sum.store_aligned(tap_[d][k].data());
      }
    }
    first.store_aligned(first_.data());
  }
  /// value[p] := that at place p, for all of them that `count` has.
  void operator()(const T* values, std::size_t count, T* value) const {
    alignas(64) T row[places * lanes], column[places * lanes];
    for (std::size_t p = 0; p < count; ++p) plane_sum(values, p).store_aligned(row + p * lanes);
    std::fill(row + count * lanes, row + places * lanes, T(0));
    for (std::size_t p = 0; p < count; p += lanes) {
      simd::transpose<lanes>(row + p * lanes, lanes, column + p, places);
    }
    Lanes sum(T(0));
    for (int i = 0; i < K::support; ++i) {
      sum = fma(Lanes::load_aligned(tap_[0][i].data()),
                Lanes::load_aligned(column + static_cast<std::size_t>(i) * places), sum);
    }
    sum.store_aligned(value);
  }

 private:
  using Lanes = simd::Pack<T, places>;
  using Row = simd::Pack<T, lanes>;

  /// The sums over all axes but the first at place p, a lane for each tap of that.
  Row plane_sum(const T* values, std::size_t p) const {
    const T* row = values + static_cast<std::ptrdiff_t>(first_[p]);
    Row total(T(0));
    Row weight[K::support];
    for (int j = 0; j < K::support; ++j) weight[j] = Row(tap_[1][j][p]);
    const auto plane_at = [&](const T* at) {
      Row plane = Row::load(at) * weight[0];
#pragma GCC unroll 8
      for (int j = 1; j < K::support; ++j) plane = fma(Row::load(at + j * stride_[1]), weight[j], plane);
      return plane;
    };
    if constexpr (D == 2) {
      total = plane_at(row);
    } else {
#pragma GCC unroll 8
      for (int k = 0; k < K::support; ++k) {
        total = fma(plane_at(row + k * stride_[D - 1]), Row(tap_[D - 1][k][p]), total);
      }
    }
    return total;
  }

  static constexpr T coefficient(int j, int k) { return static_cast<T>(Taps<K>::coefficients.value[j][k]); }

  Index<D> stride_;
  alignas(64) std::array<std::array<std::array<T, places>, K::support>, D> tap_;
  alignas(64) std::array<T, places> first_;
};

}  // namespace cambium::detail
