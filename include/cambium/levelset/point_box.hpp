// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <cambium/core/sparse.hpp>
#include <cambium/kernels/taps.hpp>

namespace cambium::detail {

/// Reads the part of a band or field that the stencils of kernel K need around a set of points near a block.
///
/// Points are relative to the first node of the block, in spacings; after read() `corner()` is what to subtract from
/// them to have them relative to entry 0 of the patch.
template <class K, class T, int D>
class PointBox {
 public:
  bool empty() const { return low_[0] > high_[0]; }
  const Vec<D, T>& corner() const { return corner_; }

  void add(const Vec<D, T>& point) {
    for (int d = 0; d < D; ++d) {
      low_[d] = std::min(low_[d], point[d]);
      high_[d] = std::max(high_[d], point[d]);
    }
  }
  /// \param origin  first node of the block
  /// \param slack   nodes to read beyond those that the stencils of the points need
  template <class Patch, class Source>
  void read(const Source& source, const Index<D>& origin, std::ptrdiff_t slack, Patch& patch) {
    constexpr std::ptrdiff_t before = Taps<K>::before;
    constexpr std::ptrdiff_t behind = K::support - 1 - Taps<K>::before;
    Index<D> first, edge;
    for (int d = 0; d < D; ++d) {
      const auto shift = static_cast<T>(Taps<K>::shift);
      first[d] = static_cast<std::ptrdiff_t>(std::floor(low_[d] + shift)) - before - slack;
      edge[d] = static_cast<std::ptrdiff_t>(std::floor(high_[d] + shift)) + behind + slack - first[d] + 1;
      corner_[d] = static_cast<T>(first[d]);
    }
    patch.read(source, origin + first, edge);
  }

 private:
  Vec<D, T> low_ = Vec<D, T>::constant(std::numeric_limits<T>::max());
  Vec<D, T> high_ = Vec<D, T>::constant(std::numeric_limits<T>::lowest());
  Vec<D, T> corner_{};
};

/// Node i of a block, in spacings from its first.
template <class T, int D>
Vec<D, T> position_in_block(std::size_t i) {
  Vec<D, T> x;
  for (int d = 0; d < D; ++d) {
    x[d] = static_cast<T>(i % static_cast<std::size_t>(BlockShape<D>::extent));
    i /= static_cast<std::size_t>(BlockShape<D>::extent);
  }
  return x;
}

}  // namespace cambium::detail
