// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include <cambium/interface/jump_legs.hpp>
#include <cambium/levelset/closest_points.hpp>
#include <cambium/levelset/sampler.hpp>

namespace cambium::detail {

/// What jump corrections need to know of an interface: closest points, normals and curvatures of the nodes near it, and
/// the legs of stencils that are crossed. Keeps copies: the band may change or go.
template <int D, class T, class K>
class JumpGeometry {
 public:
  using Band = NarrowBand<T, D>;
  using Points = ClosestPoints<K, T, D>;
  /// Nodes that stencils across the interface reach.
  static constexpr std::ptrdiff_t wall_distance = 2;

  /// \param reach  distance in spacings up to which nodes are near. \throws ValueError if it is below 2
  JumpGeometry(const Lattice<D>& lattice, double reach)
      : reach_(reach), band_(lattice, lattice.spacing()), geometry_(lattice) {
    if (!(reach >= 2.0) || !std::isfinite(reach)) {
      throw ValueError(message("jumps are to be known up to ", reach, " spacings from the interface: stencils need 2"));
    }
  }

  template <Execution E>
  void find(const Band& band, const Points* points, UnresolvedLegs unresolved, const E& execution) {
    require_band(band);
    check_walls(band, wall_distance);
    band_ = band;
    if (points) {
      points_ = *points;
    } else {
      points_.find(band_, static_cast<double>(band_.half_width()), execution);
    }
    find_geometry(execution);
    const auto known = [&](std::size_t b, std::size_t i) { return near(b, i); };
    legs_.find(band_, geometry_, unresolved, known, patches_.front());
    if (legs_.size() == 0) throw InterfaceError("the band has no zero crossing: there is no interface to jump across");
  }

  const Lattice<D>& lattice() const { return band_.lattice(); }
  const Band& band() const { return band_; }
  const Points& points() const { return points_; }
  const JumpLegs<D>& legs() const { return legs_; }
  T curvature(std::size_t b, std::size_t i) const { return geometry_.mean.block(b)[i]; }
  const Vec<D, T>& normal(std::size_t b, std::size_t i) const { return geometry_.normal.block(b)[i]; }
  double reach() const { return reach_; }
  /// True if node i of block b has a closest point within reach.
  bool near(std::size_t b, std::size_t i) const {
    return points_.found(b, i) && static_cast<double>(norm(points_.offset(b, i))) <= reach_;
  }
  /// Calls at(i, u) for the near nodes i of block b, u being the closest point in spacings from entry 0 of `patch`,
  /// which is read from `source`; and without(i) for the other nodes.
  template <class Kernel, class Source, class Patch, class At, class Without>
  void for_each_near(std::size_t b, const Source& source, Patch& patch, At&& at, Without&& without) const {
    const auto point = [&](std::size_t i) { return position_in_block<T, D>(i) + points_.offset(b, i); };
    PointBox<Kernel, T, D> box;
    for (std::size_t i = 0; i < Band::volume; ++i) {
      if (near(b, i)) box.add(point(i));
    }
    if (!box.empty()) box.read(source, band_.values().block_origin(b), 0, patch);
    for (std::size_t i = 0; i < Band::volume; ++i) {
      if (near(b, i)) {
        at(i, point(i) - box.corner());
      } else {
        without(i);
      }
    }
  }
  /// Signed distance of a node that has a closest point.
  T distance(std::size_t b, std::size_t i) const {
    return std::copysign(norm(points_.offset(b, i)) * static_cast<T>(band_.spacing()), band_.values().block(b)[i]);
  }
  /// Position of its closest point.
  Vec<D> closest_point(std::size_t b, std::size_t i) const {
    Vec<D> x = lattice().position(band_.values().node(b, i));
    const Vec<D, T> offset = points_.offset(b, i);
    for (int d = 0; d < D; ++d) x[d] += static_cast<double>(offset[d]) * band_.spacing();
    return lattice().domain().wrap(x);
  }

 private:
  void require_band(const Band& band) const {
    if (!(band.lattice() == lattice())) {
      throw SizeError("the band is not on the lattice that the jump was made for: make one jump per lattice");
    }
    // Stencils of kernel K around the interface take nodes that have closest points.
    const double needed = 0.5 * K::support * std::sqrt(static_cast<double>(D)) * band.spacing();
    if (!(static_cast<double>(band.half_width()) >= needed)) {
      throw ValueError(message("half width of the band is ", static_cast<double>(band.half_width()),
                               ", but stencils around the interface reach ", needed, ": choose a wider band"));
    }
  }
  template <Execution E>
  void find_geometry(const E& execution) {
    geometry_.take_blocks(band_);
    patches_.resize(static_cast<std::size_t>(execution.count()));
    const T h = static_cast<T>(band_.spacing());
    for_each_piece_by_worker(execution, band_.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
      Patch<T, D>& patch = patches_[worker];
      for_each_near<K>(
          b, band_, patch,
          [&](std::size_t i, const Vec<D, T>& u) {
            geometry_.set(b, i, surface_geometry(Interpolant<K, T, D>::jet(patch.data(), patch.stride(), u), h));
          },
          [&](std::size_t i) { geometry_.set(b, i, {}); });
    });
  }

  double reach_;
  Band band_;
  Points points_;
  std::vector<Patch<T, D>> patches_;
  BandGeometry<T, D> geometry_;
  JumpLegs<D> legs_;
};

}  // namespace cambium::detail
