// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <cambium/levelset/narrow_band.hpp>
#include <cambium/levelset/point_bins.hpp>

namespace cambium::detail {

/// For every node of a block, which of the points offered is the nearest. Of points at the same distance the first.
template <class T, int D>
class NearestCandidates {
 public:
  static constexpr std::size_t volume = NarrowBand<T, D>::volume;

  /// Forgets all points. \param width  distance up to which points count, in spacings
  void reset(T width) {
    width_ = width;
    square_.fill(width * width);
    candidate_.fill(T(-1));
    points_.clear();
    sources_.clear();
  }
  /// \param point   relative to the first node of the block, in spacings
  /// \param source  whatever it is to be known by
  void offer(const Vec<D, T>& point, std::size_t source) {
    Index<D> first{}, last{};
    for (int d = 1; d < D; ++d) {
      first[d] = std::max<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(std::ceil(point[d] - width_)), 0);
      last[d] = std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(std::floor(point[d] + width_)), extent - 1);
    }
    if (point[0] + width_ < T(0) || point[0] - width_ > static_cast<T>(extent - 1)) return;
    const T number = static_cast<T>(points_.size());
    points_.push_back(point);
    sources_.push_back(source);
    const std::ptrdiff_t from = D == 3 ? first[D - 1] : 0;
    const std::ptrdiff_t to = D == 3 ? last[D - 1] : 0;
    for (std::ptrdiff_t k = from; k <= to; ++k) {
      const T high = D == 3 ? static_cast<T>(k) - point[D - 1] : T(0);
      for (std::ptrdiff_t j = first[1]; j <= last[1]; ++j) {
        const T across = static_cast<T>(j) - point[1];
        const T square = high * high + across * across;
        if (square < width_ * width_) offer_row((k * extent + j) * extent, point[0], square, number);
      }
    }
  }
  /// True if a point is within the width of node i.
  bool found(std::size_t i) const { return !(candidate_[i] < T(0)); }
  /// The nearest point of node i, and its source.
  const Vec<D, T>& point(std::size_t i) const { return points_[static_cast<std::size_t>(candidate_[i])]; }
  std::size_t source(std::size_t i) const { return sources_[static_cast<std::size_t>(candidate_[i])]; }

 private:
  static constexpr std::ptrdiff_t extent = NarrowBand<T, D>::extent;

  void offer_row(std::ptrdiff_t row, T x, T square, T number) {
    T* best = square_.data() + row;
    T* candidate = candidate_.data() + row;
    for (std::ptrdiff_t i = 0; i < extent; ++i) {
      const T along = static_cast<T>(i) - x;
      const T distance = along * along + square;
      const bool nearer = distance < best[i];
      best[i] = nearer ? distance : best[i];
      candidate[i] = nearer ? number : candidate[i];
    }
  }

  T width_{};
  alignas(64) std::array<T, volume> square_;
  /// Numbers in the type of distances, so that one comparison of vectors serves both.
  alignas(64) std::array<T, volume> candidate_;
  std::vector<Vec<D, T>> points_;
  std::vector<std::size_t> sources_;
};

/// Calls f(block, shift) for every stored block with nodes within `reach` nodes of block b; see for_each_block_within.
template <class T, int D, class F>
void for_each_block_around(const NarrowBand<T, D>& band, std::size_t b, std::ptrdiff_t reach, F&& f) {
  for_each_block_within(band.lattice(), band.values().block_index(b), reach,
                        [&](const Index<D>& block, const Index<D>& shift) {
                          const std::ptrdiff_t other = band.values().find(block);
                          if (other >= 0) f(static_cast<std::size_t>(other), shift);
                        });
}

}  // namespace cambium::detail
