// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include <cambium/kernels/lambda.hpp>
#include <cambium/levelset/inside_components.hpp>
#include <cambium/levelset/interface_extremum.hpp>
#include <cambium/levelset/interface_integral.hpp>

namespace cambium {

/// What an interface encloses and how it is shaped, in length units.
template <int D>
struct Measures {
  double volume = 0.0;  ///< of the inside; the area enclosed in 2D
  double area = 0.0;    ///< of the interface; its length in 2D
  Vec<D> centroid;      ///< of the inside, brought into the box along periodic axes
  Box<D> extents;       ///< smallest box around the interface; it may reach over the upper face of a periodic axis
  double least_curvature = 0.0;  ///< sums of the principal curvatures on the interface; positive where it is convex
  double greatest_curvature = 0.0;
  std::size_t inside_components = 0;     ///< connected parts of the inside
  std::size_t interface_components = 0;  ///< connected parts of the interface
  std::size_t cells = 0;                 ///< cells of the lattice that the interface cuts
  /// Points of curved elements that no projection reached, so that the element is flat there: the interface is
  /// under-resolved, and the order is lost nearby. Zero for a smooth interface.
  std::size_t unresolved = 0;
};

namespace detail {

/// One pass over the cells that the interface cuts, and the sums of what it finds.
template <class K, class T, int D>
class InterfaceMeasures {
 public:
  template <Execution E>
  InterfaceMeasures(const NarrowBand<T, D>& band, const E& execution) : band_(band), cells_(band, true, execution) {
    count_cells();
    find_begin();
    const auto sums = InterfaceIntegral<K, T, D>(cells_)(begin_, execution);
    add_up(sums);
    count_components(sums, execution);
    find_extremes();
  }
  const Measures<D>& result() const { return result_; }

 private:
  /// Cells inside and cut, by their place along each axis.
  void count_cells() {
    const Lattice<D>& lattice = band_.lattice();
    for (int d = 0; d < D; ++d) {
      inside_[d].assign(static_cast<std::size_t>(lattice.nodes()[d]), 0);
      crossed_[d].assign(static_cast<std::size_t>(lattice.nodes()[d]), 0);
    }
    for (std::size_t b = 0; b < band_.blocks(); ++b) {
      const Index<D> origin = band_.values().block_origin(b);
      for (int d = 0; d < D; ++d) {
        const std::ptrdiff_t end = std::min<std::ptrdiff_t>(BlockShape<D>::extent, lattice.nodes()[d] - origin[d]);
        for (std::ptrdiff_t i = 0; i < end; ++i) {
          inside_[d][static_cast<std::size_t>(origin[d] + i)] += cells_.blocks()[b].inside[d][i];
          crossed_[d][static_cast<std::size_t>(origin[d] + i)] += cells_.blocks()[b].crossed[d][i];
        }
      }
    }
    const Index<D>& grid = band_.values().block_grid();
    for (std::ptrdiff_t k = 0; k < product(grid); ++k) {
      Index<D> block;
      std::ptrdiff_t rest = k;
      for (int d = 0; d < D; ++d) {
        block[d] = rest % grid[d];
        rest /= grid[d];
      }
      if (band_.values().find(block) < 0 && band_.far_value(block) < T(0)) count_far(block * BlockShape<D>::extent);
    }
  }
  /// A block that is not stored and inside: all its cells are.
  void count_far(const Index<D>& origin) {
    Index<D> size;
    for (int d = 0; d < D; ++d) {
      const std::ptrdiff_t cells = band_.lattice().nodes()[d] - (band_.lattice().periodic(d) ? 0 : 1);
      size[d] = std::min<std::ptrdiff_t>(BlockShape<D>::extent, cells - origin[d]);
    }
    for (int d = 0; d < D; ++d) {
      for (std::ptrdiff_t i = 0; i < size[d]; ++i) {
        inside_[d][static_cast<std::size_t>(origin[d] + i)] += product(size) / size[d];
      }
    }
  }
  /// Periodic axes are cut open behind cells that hold nothing of the inside; where there are none, at the face.
  void find_begin() {
    for (int d = 0; d < D; ++d) {
      begin_[d] = 0;
      const auto empty = [&](std::size_t k) { return inside_[d][k] == 0 && crossed_[d][k] == 0; };
      if (!band_.lattice().periodic(d) || empty(inside_[d].size() - 1)) continue;
      for (std::size_t k = inside_[d].size() - 1; k-- > 0 && begin_[d] == 0;) {
        if (empty(k)) begin_[d] = static_cast<std::ptrdiff_t>(k + 1);
      }
    }
  }
  double opened(int d, double place) const {
    const bool before = place < static_cast<double>(begin_[d]);
    return before ? place + static_cast<double>(band_.lattice().nodes()[d]) : place;
  }

  void add_up(const std::vector<BlockIntegral<D>>& sums) {
    CompensatedSum area, volume;
    std::array<CompensatedSum, D> first;
    for (int d = 0; d < D; ++d) {
      for (std::size_t k = 0; k < inside_[d].size(); ++k) {
        const auto cells = static_cast<double>(inside_[d][k]);
        if (d == 0) volume += cells;
        if (d == 0) result_.cells += static_cast<std::size_t>(crossed_[d][k]);
        first[d] += cells * (opened(d, static_cast<double>(k)) + 0.5);
      }
    }
    for (const BlockIntegral<D>& block : sums) {
      area += block.area;
      volume += block.inside.volume;
      for (int d = 0; d < D; ++d) first[d] += block.inside.first[d];
      result_.unresolved += block.unresolved;
    }
    const double h = band_.spacing();
    result_.area = area.value() * std::pow(h, D - 1);
    result_.volume = volume.value() * std::pow(h, D);
    for (int d = 0; d < D; ++d) {
      result_.centroid[d] = band_.lattice().box().lo[d] + first[d].value() / volume.value() * h;
    }
    result_.centroid = band_.lattice().domain().wrap(result_.centroid);
  }

  template <Execution E>
  void count_components(const std::vector<BlockIntegral<D>>& sums, const E& execution) {
    DisjointSets pieces(cells_.vertices());
    std::vector<std::pair<Index<D>, Index<D>>> joins;
    for (const BlockIntegral<D>& block : sums) {
      for (const auto& [a, b] : block.shared) pieces.join(a, b);
      for (const auto& [a, b] : block.joins) joins.emplace_back(band_.inside(a), band_.inside(b));
    }
    for (std::size_t v = 0; v < cells_.vertices(); ++v) {
      result_.interface_components += pieces.stands_for_set(v) ? 1 : 0;
    }
    result_.inside_components = InsideComponents<T, D>(band_).count(joins, execution);
  }

  /// The crossing of greatest rank(v), the first of several.
  template <class Rank>
  std::size_t greatest(Rank&& rank) const {
    std::size_t best = 0;
    for (std::size_t v = 1; v < cells_.vertices(); ++v) {
      if (rank(v) > rank(best) || std::isnan(rank(best))) best = v;
    }
    return best;
  }
  void find_extremes() {
    InterfaceExtremum<K, T, D> climb(band_);
    const double h = band_.spacing();
    for (const double sign : {-1.0, 1.0}) {
      const std::size_t v = greatest([&](std::size_t i) { return sign * cells_.curvature(i); });
      const double value = sign * climb(cells_.point(v), {-1, sign});
      (sign < 0.0 ? result_.least_curvature : result_.greatest_curvature) = value / h;
      for (int d = 0; d < D; ++d) {
        const std::size_t far = greatest([&](std::size_t i) { return sign * opened(d, cells_.point(i)[d]); });
        const double shift = opened(d, cells_.point(far)[d]) - cells_.point(far)[d];
        const double place = sign * climb(cells_.point(far), {d, sign});
        (sign < 0.0 ? result_.extents.lo : result_.extents.hi)[d] = band_.lattice().box().lo[d] + (place + shift) * h;
      }
    }
  }

  const NarrowBand<T, D>& band_;
  InterfaceCells<K, T, D> cells_;
  std::array<std::vector<std::ptrdiff_t>, D> inside_, crossed_;
  Index<D> begin_;
  Measures<D> result_;
};

}  // namespace detail

/// Measures of the interface of a band and of what it encloses, by one quadrature over the interface.
///
/// The interface is the zero set of kernel K's interpolant: values may be of any smooth scaling, negative inside.
/// In every cell that it cuts it is a polynomial through points projected onto it: errors of volume, area and centroid
/// are O(h^4), of extents O(h^5), of curvatures O(h^3), for Lambda_{4,4} and a smooth interface. Volumes are summed
/// cell by cell, so that an inside that wraps around periodic axes counts with the volume it has in the box. Where the
/// inside leaves a gap along a periodic axis, centroid and extents are those of the body that continues through the
/// face; where it leaves none, those of its pieces in the box. Parts of the interface that enclose no node are not
/// seen. \tparam K  interpolating kernel of even support \throws InterfaceError if there is no interface, it touches a
/// bounded face of the box, or reaches blocks that are not
///         stored; ValueError if a value is not finite
template <class K = Lambda<4, 4>, class T, int D, Execution E = OpenMP>
Measures<D> measures(const NarrowBand<T, D>& band, const E& execution = {}) {
  return detail::InterfaceMeasures<K, T, D>(band, execution).result();
}

}  // namespace cambium
