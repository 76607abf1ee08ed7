// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include <cambium/core/aligned.hpp>
#include <cambium/core/sparse.hpp>
#include <cambium/simd/pack.hpp>

namespace cambium::detail {

/// For every node of a block, which of the points offered is the nearest, distances being compared in single precision.
///
/// Points that are offered one after the other are taken to lie near each other: 8 at a time have a bounding box, and a
/// tile of 16 nodes looks only into boxes that are nearer than the worst of its nodes so far.
template <class T, int D, class Source>
class NearestPoints {
 public:
  static constexpr std::size_t volume = BlockShape<D>::volume;

  /// Forgets all points. \param width  distance up to which points count, in spacings
  void reset(T width) {
    width_ = static_cast<float>(width);
    points_.clear();
    sources_.clear();
    for (auto& column : position_) column.clear();
  }
  /// \param point   relative to the first node of the block, in spacings
  /// \param source  whatever it is to be known by
  void offer(const Vec<D, T>& point, const Source& source) {
    T square{};
    for (int d = 0; d < D; ++d) {
      const T beyond = point[d] - std::clamp(point[d], T(0), static_cast<T>(extent - 1));
      square += beyond * beyond;
    }
    if (!(square < static_cast<T>(width_ * width_))) return;
    points_.push_back(point);
    sources_.push_back(source);
    for (int d = 0; d < D; ++d) position_[d].push_back(static_cast<float>(point[d]));
  }
  bool empty() const { return points_.empty(); }
  /// Finds the nearest points; to be called after the last offer().
  void settle() {
    bound_clusters();
    for (std::size_t tile = 0; tile < volume / lanes; ++tile) settle(tile);
  }
  /// True if a point is within the width of node i.
  bool found(std::size_t i) const { return !(nearest_[i] < 0.0F); }
  /// The nearest point of node i, and its source.
  const Vec<D, T>& point(std::size_t i) const { return points_[static_cast<std::size_t>(nearest_[i])]; }
  const Source& source(std::size_t i) const { return sources_[static_cast<std::size_t>(nearest_[i])]; }

 private:
  static constexpr std::ptrdiff_t extent = BlockShape<D>::extent;
  static constexpr std::size_t lanes = 16;
  static constexpr std::size_t cluster = 8;
  using Lanes = simd::Pack<float, lanes>;
  static_assert(lanes % extent == 0 && lanes / extent <= extent, "a tile is a row or several along axis 1");
  using Corner = std::array<float, D>;

  void bound_clusters() {
    clusters_ = (points_.size() + cluster - 1) / cluster;
    const std::size_t padded = (clusters_ + lanes - 1) / lanes * lanes;
    square_.resize(padded);
    for (int d = 0; d < D; ++d) {
      low_[d].assign(padded, std::numeric_limits<float>::max());
      high_[d].assign(padded, std::numeric_limits<float>::lowest());
      for (std::size_t p = 0; p < points_.size(); ++p) {
        float& low = low_[d][p / cluster];
        float& high = high_[d][p / cluster];
        low = std::min(low, position_[d][p]);
        high = std::max(high, position_[d][p]);
      }
    }
  }
  void settle(std::size_t tile) {
    alignas(64) std::array<float, lanes> best;
    best.fill(width_ * width_);
    std::fill_n(nearest_.begin() + static_cast<std::ptrdiff_t>(tile * lanes), lanes, -1.0F);
    const Corner origin = first_node(tile);
    measure_clusters(origin);
    std::size_t first = 0;
    for (std::size_t c = 1; c < clusters_; ++c) first = square_[c] < square_[first] ? c : first;
    if (clusters_ == 0) return;
    float worst = best[0];
    const auto look = [&](std::size_t c) {
      if (square_[c] < worst) worst = look_into(c, origin, best.data(), nearest_.data() + tile * lanes);
    };
    look(first);
    square_[first] = std::numeric_limits<float>::infinity();
    for (std::size_t c = 0; c < clusters_; ++c) look(c);
  }
  static Corner first_node(std::size_t tile) {
    Corner origin{};
    std::size_t i = tile * lanes;
    for (int d = 0; d < D; ++d) {
      origin[d] = static_cast<float>(i % static_cast<std::size_t>(extent));
      i /= static_cast<std::size_t>(extent);
    }
    return origin;
  }
  /// Squared distances between the nodes of a tile and every cluster, at least.
  void measure_clusters(const Corner& origin) {
    for (std::size_t c = 0; c < clusters_; c += lanes) {
      Lanes square(0.0F);
      for (int d = 0; d < D; ++d) {
        constexpr std::array<std::ptrdiff_t, 2> length{extent - 1, static_cast<std::ptrdiff_t>(lanes) / extent - 1};
        const float last = origin[d] + (d < 2 ? static_cast<float>(length[d]) : 0.0F);
        const Lanes before = Lanes::load_aligned(low_[d].data() + c) - Lanes(last);
        const Lanes behind = Lanes(origin[d]) - Lanes::load_aligned(high_[d].data() + c);
        const Lanes gap = max(Lanes(0.0F), max(before, behind));
        square = fma(gap, gap, square);
      }
      square.store_aligned(square_.data() + c);
    }
  }
  /// \return the largest of the squared distances `best`
  float look_into(std::size_t c, const Corner& origin, float* best, float* nearest) const {
    alignas(64) static constexpr auto node = [] {
      std::array<std::array<float, lanes>, 2> result{};
      for (std::size_t l = 0; l < lanes; ++l) {
        const std::size_t row = l / extent;
        result[0][l] = static_cast<float>(l % extent);
        result[1][l] = static_cast<float>(row);
      }
      return result;
    }();
    const Lanes x = Lanes::load_aligned(node[0].data());
    const Lanes y = Lanes::load_aligned(node[1].data());
    Lanes smallest = Lanes::load_aligned(best);
    Lanes number = Lanes::load_aligned(nearest);
    const std::size_t end = std::min(points_.size(), (c + 1) * cluster);
    for (std::size_t p = c * cluster; p < end; ++p) {
      const float above = D == 3 ? position_[D - 1][p] - origin[D - 1] : 0.0F;
      const Lanes along = x - Lanes(position_[0][p]);
      const Lanes across = y - Lanes(position_[1][p] - origin[1]);
      const Lanes square = fma(along, along, fma(across, across, Lanes(above * above)));
      const Lanes smaller = min(smallest, square);
      number = where_equal(smaller, smallest, number, Lanes(static_cast<float>(p)));
      smallest = smaller;
    }
    smallest.store_aligned(best);
    number.store_aligned(nearest);
    return -lowest_lane(Lanes(0.0F) - smallest);
  }

  float width_ = 0.0F;
  alignas(64) std::array<float, volume> nearest_{};
  std::vector<Vec<D, T>> points_;
  std::vector<Source> sources_;
  std::array<AlignedVector<float>, D> position_;
  std::size_t clusters_ = 0;
  std::array<AlignedVector<float>, D> low_, high_;  ///< bounding boxes of the clusters
  AlignedVector<float> square_;                     ///< least squared distance of each from the nodes of a tile
};

}  // namespace cambium::detail
