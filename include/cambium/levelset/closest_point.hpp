// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <cambium/levelset/closest_points.hpp>
#include <cambium/levelset/reinit/band_work.hpp>
#include <cambium/levelset/reinitialisation.hpp>

namespace cambium {

/// Reinitialisation by closest points: phi := +-|x - closest point|, of the order of kernel K; the default.
///
/// A node whose value already is the distance, to within what the values around it can tell (the difference between two
/// kernels of different order), keeps it to the last bit: so a second call changes nothing, and a thousand calls do not
/// move the interface.
template <class K>
struct BasicClosestPoint {
  /// In spacings: stencils of points next to the interface must find phi as it is.
  static constexpr double least_half_width = 5.0;

  struct Params {
    /// Distance in spacings up to which extend_slopes() takes phi for granted.
    double known = 2.5;
    /// Difference between two kernels, in spacings, up to which extend_slopes() takes the interface as resolved.
    double resolved = 1e-3;
  };

  template <class T, int D>
  class Method {
   public:
    Method() = default;
    explicit Method(const Params& params) : params_(params) {}

    /// phi := signed distance at every node of the blocks within the half width, +-half width at the others.
    /// \throws ValueError if phi is not finite; phi is then unchanged
    template <Execution E>
    ReinitReport operator()(NarrowBand<T, D>& band, const E& execution) {
      detail::require_finite(band, execution);
      points_.find(band, static_cast<double>(band.half_width()), execution);
      for_each_piece(execution, band.blocks(), 1, [&](std::size_t b, std::size_t) {
        const auto phi = band.values().block(b);
        for (std::size_t i = 0; i < phi.size(); ++i) phi[i] = distance(band, b, i, phi[i]);
      });
      const ClosestPointCounts& counts = points_.counts();
      return {counts.nodes, counts.lower_order, counts.not_searched, 1};
    }
    /// Carries phi on outwards where it is known well next to the interface only, as after an interpolation: beyond
    /// Params::known, phi := +-|grad phi| at the closest point times the distance. Slopes stay as they are, so that
    /// there is no kink for the next interpolation to spread. Under-resolved parts are left alone.
    template <Execution E>
    void extend_slopes(NarrowBand<T, D>& band, const E& execution) {
      points_.find(band, static_cast<double>(band.half_width()), execution);
      for_each_piece(execution, band.blocks(), 1, [&](std::size_t b, std::size_t) {
        const auto phi = band.values().block(b);
        for (std::size_t i = 0; i < phi.size(); ++i) phi[i] = extended(band, b, i, phi[i]);
      });
    }
    /// The blocks of the band have new numbers: block b was block came_from[b], or -1 if it is new.
    void take_blocks(const std::vector<std::ptrdiff_t>& came_from) { points_.take_blocks(came_from); }
    /// Closest points of the nodes at the last call.
    const ClosestPoints<K, T, D>& points() const { return points_; }
    /// Saves or restores them, for a band of so many blocks, see SnapshotWriter.
    template <class Self, class Archive>
    static void visit(Self& self, Archive& archive, std::size_t blocks) {
      ClosestPoints<K, T, D>::visit(self.points_, archive, blocks);
    }

   private:
    T extended(const NarrowBand<T, D>& band, std::size_t b, std::size_t i, T phi) const {
      const T far = phi < T(0) ? -band.half_width() : band.half_width();
      if (!points_.found(b, i)) return far;
      T value = std::abs(phi);
      const T distance = norm(points_.offset(b, i));
      if (distance > static_cast<T>(params_.known) && points_.error(b, i) < static_cast<T>(params_.resolved)) {
        value = distance * static_cast<T>(band.spacing()) * points_.slope(b, i);
      }
      // Where phi is so steep that it leaves the band next to the interface, it is made a distance.
      if (!(value < band.half_width())) value = distance * static_cast<T>(band.spacing());
      return value < band.half_width() ? std::copysign(value, phi) : far;
    }
    T distance(const NarrowBand<T, D>& band, std::size_t b, std::size_t i, T phi) const {
      const T far = phi < T(0) ? -band.half_width() : band.half_width();
      if (!points_.found(b, i)) return far;
      const T h = static_cast<T>(band.spacing());
      const T length = norm(points_.offset(b, i)) * h;
      const T round_off = T(16) * std::numeric_limits<T>::epsilon() * band.half_width();
      const bool is_distance = std::abs(length - std::abs(phi)) <= T(2) * points_.error(b, i) * h + round_off;
      if (is_distance && band.in_band(phi)) return phi;
      return band.in_band(length) ? (phi < T(0) ? -length : length) : far;
    }

    Params params_;
    ClosestPoints<K, T, D> points_;
  };
};

/// Closest points by the fifth-order kernel Lambda_{4,4}: four continuous derivatives, so that curvature is continuous.
using ClosestPoint = BasicClosestPoint<Lambda<4, 4>>;

}  // namespace cambium
