// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <cambium/levelset/closest_point_walk.hpp>
#include <cambium/levelset/geometry/band_geometry.hpp>

namespace cambium {

/// Normals and curvatures of the interface itself: those of the interpolant of kernel K at the closest point of each
/// node, and so constant along normals by construction.
///
/// Takes phi of any scaling. Defined at all nodes of the blocks within the half width of the interface (unless their
/// search failed). K reproduces degree m: order m for normals and m - 1 for curvatures, 4 and 3 with the default. The
/// stencils must not reach values that are cut off: a half width of at least sqrt(D) K::support / 2 spacings, 5.2 in
/// 3D.
template <class K = Lambda<4, 4>>
struct AtClosestPoints {
  struct Params {};

  template <class T, int D>
  class Method {
   public:
    using Points = ClosestPoints<K, T, D>;

    Method() = default;
    explicit Method(const Params&) {}

    /// Finds the closest points first.
    template <Execution E>
    void operator()(const NarrowBand<T, D>& band, BandGeometry<T, D>& geometry, const E& execution) {
      points_.find(band, static_cast<double>(band.half_width()), execution);
      (*this)(band, points_, geometry, execution);
    }
    /// From closest points that are known: those of points.find(band, ...), by any kernel.
    template <class Found, Execution E>
    void operator()(const NarrowBand<T, D>& band, const ClosestPoints<Found, T, D>& points,
                    BandGeometry<T, D>& geometry, const E& execution) {
      geometry.take_blocks(band);
      patches_.resize(static_cast<std::size_t>(execution.count()));
      const T h = static_cast<T>(band.spacing());
      for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
        Patch<T, D>& patch = patches_[worker];
        detail::for_each_closest_point<K>(
            points, band, b, band, patch,
            [&](std::size_t i, const Vec<D, T>& u) {
              const Jet<T, D> jet = Interpolant<K, T, D>::jet(patch.data(), patch.stride(), u);
              geometry.set(b, i, surface_geometry(jet, h));
            },
            [&](std::size_t i) { geometry.set(b, i, {}); });
      });
    }
    /// Closest points of the last call that found them.
    const Points& points() const { return points_; }

   private:
    Points points_;
    std::vector<Patch<T, D>> patches_;
  };
};

}  // namespace cambium
