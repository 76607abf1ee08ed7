// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include <cambium/core/aligned.hpp>
#include <cambium/core/box.hpp>
#include <cambium/core/columns.hpp>

namespace cambium::detail {

/// Points that are neighbours in the order of their tree.
template <int D>
struct Cluster {
  Box<D> box;              ///< the smallest around the points
  double radius = 0.0;     ///< of the smallest ball around them with the centre of the box
  std::size_t begin = 0;   ///< of the points, in the order of the tree
  std::size_t end = 0;     ///< one past the last of them
  std::size_t child = 0;   ///< number of the first of two children, which follow each other; 0 if there are none
  std::size_t number = 0;  ///< among the clusters without children

  std::size_t count() const { return end - begin; }
  /// Length that expansions are made in.
  double unit() const { return radius > 0.0 ? radius : 1.0; }
};

/// From x to the nearest point of the box.
template <int D>
double distance(const Box<D>& box, const Vec<D>& x) {
  double square = 0.0;
  for (int d = 0; d < D; ++d) {
    const double one = std::max({box.lo[d] - x[d], x[d] - box.hi[d], 0.0});
    square += one * one;
  }
  return std::sqrt(square);
}

/// Points halved again and again across the longest side of their box, down to `most` of them. Buffers are kept.
template <int D>
class ClusterTree {
 public:
  /// \param granule  larger clusters hold a multiple of this many points, but for the last: they fill vectors
  void build(Columns<D, const double> points, std::size_t most, std::size_t granule) {
    build(points, most, granule, [](const Cluster<D>&) { return true; });
  }
  /// \param compact  says of a cluster whether it may stay as it is, or is to be split further, down to a point
  template <class Compact>
  void build(Columns<D, const double> points, std::size_t most, std::size_t granule, Compact&& compact) {
    order_.resize(points.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    clusters_.assign(1, {});
    leaves_.clear();
    clusters_[0].end = points.size();
    for (std::size_t c = 0; c < clusters_.size(); ++c) {
      measure(points, clusters_[c]);
      const bool large = clusters_[c].count() > 1 && clusters_[c].radius > 0.0 && !compact(clusters_[c]);
      if (clusters_[c].count() > std::max(most, granule) || large) {
        split(points, c, granule);
      } else if (clusters_[c].count() > 0) {
        clusters_[c].number = leaves_.size();
        leaves_.push_back(c);
      }
    }
    for (int d = 0; d < D; ++d) {
      auto& x = points_[static_cast<std::size_t>(d)];
      x.resize(points.size());
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = points.column(d)[order_[i]];
    }
  }

  /// Parents before children; the first holds all points.
  const std::vector<Cluster<D>>& clusters() const { return clusters_; }
  /// Numbers of the clusters without children.
  const std::vector<std::size_t>& leaves() const { return leaves_; }
  /// A radius that clusters at x may have without being much larger than those of this tree there.
  double local_radius(const Vec<D>& x) const {
    std::size_t c = 0;
    while (clusters_[c].child > 0) {
      const std::size_t child = clusters_[c].child;
      c = distance(clusters_[child].box, x) <= distance(clusters_[child + 1].box, x) ? child : child + 1;
    }
    return 2.0 * clusters_[c].radius + 0.5 * distance(clusters_[c].box, x);
  }
  /// The number that the points had before, in the order of the tree.
  const std::vector<std::size_t>& order() const { return order_; }
  /// A coordinate of the points in the order of the tree.
  const AlignedVector<double>& coordinate(int d) const { return points_[static_cast<std::size_t>(d)]; }

 private:
  void measure(Columns<D, const double> points, Cluster<D>& cluster) const {
    if (cluster.count() == 0) return;
    cluster.box.lo = cluster.box.hi = points[order_[cluster.begin]];
    for (std::size_t i = cluster.begin; i < cluster.end; ++i) {
      for (int d = 0; d < D; ++d) {
        const double x = points.column(d)[order_[i]];
        cluster.box.lo[d] = std::min(cluster.box.lo[d], x);
        cluster.box.hi[d] = std::max(cluster.box.hi[d], x);
      }
    }
    const Vec<D> centre = cluster.box.centre();
    double square = 0.0;
    for (std::size_t i = cluster.begin; i < cluster.end; ++i) {
      const Vec<D> away = points[order_[i]] - centre;
      square = std::max(square, dot(away, away));
    }
    cluster.radius = std::sqrt(square);
  }
  void split(Columns<D, const double> points, std::size_t c, std::size_t granule) {
    const Cluster<D> whole = clusters_[c];
    int axis = 0;
    for (int d = 1; d < D; ++d) axis = whole.box.extent()[d] > whole.box.extent()[axis] ? d : axis;
    const double* const x = points.column(axis).data();
    if (whole.count() <= granule) granule = 1;
    const std::size_t middle = whole.begin + (whole.count() / 2 + granule - 1) / granule * granule;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(whole.begin), at(middle), at(whole.end),
                     [x](std::size_t a, std::size_t b) { return x[a] < x[b] || (x[a] == x[b] && a < b); });
    clusters_[c].child = clusters_.size();
    Cluster<D> half;
    half.begin = whole.begin;
    half.end = middle;
    clusters_.push_back(half);
    half.begin = middle;
    half.end = whole.end;
    clusters_.push_back(half);
  }

  std::vector<Cluster<D>> clusters_ = std::vector<Cluster<D>>(1);
  std::vector<std::size_t> leaves_;
  std::vector<std::size_t> order_;
  std::array<AlignedVector<double>, D> points_;
};

}  // namespace cambium::detail
