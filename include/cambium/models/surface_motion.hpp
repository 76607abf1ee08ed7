// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <optional>
#include <vector>

#include <cambium/levelset/geometry/at_closest_points.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/models/band_velocity.hpp>
#include <cambium/surface/point_reader.hpp>
#include <cambium/surface/surface_band.hpp>

namespace cambium {

/// What moves the surface of a SurfacePattern:
///   M::moves                                     false: nothing of a moving surface is compiled
///   M::coupled                                   whether the velocity depends on the surface or the species
///   motion.velocity(level_set, band, c, execution)   u(Vec<D, T> x, double t), valid near the surface until the next
///   call;
///                                                c: Columns of the species on the band
/// The surface stays where it is.
struct FixedSurface {
  static constexpr bool moves = false;
  static constexpr bool coupled = false;
};

/// u(x, t), a function of one's own.
template <class U>
struct PrescribedMotion {
  static constexpr bool moves = true;
  static constexpr bool coupled = false;
  U u;

  template <class L, class B, class C, class E>
  const U& velocity(const L&, const B&, const C&, const E&) const {
    return u;
  }
};
template <class U>
PrescribedMotion(U) -> PrescribedMotion<U>;

/// u = rate c_species n: the surface grows where there is much of a species (Bergdorf, Milde & Koumoutsakos, eq. 11.60,
/// with rate 1 and the first). Constant along normals.
template <int D = 3, class T = double>
class GrowthBySpecies {
 public:
  static constexpr bool moves = true;
  static constexpr bool coupled = true;

  explicit GrowthBySpecies(double rate = 1.0, int species = 0) : rate_(rate), species_(species) {}

  template <class L, class Stencil, class C, class E>
  const BandVelocity<T, D>& velocity(const L& level_set, const SurfaceBand<Stencil, D, T>& band, const C& c,
                                     const E& execution) {
    const auto& narrow = level_set.band();
    const auto& points = level_set.method().points();
    if (!velocity_) velocity_.emplace(level_set.lattice());
    velocity_->fit(narrow);
    normals_(narrow, points, geometry(level_set), execution);
    list(narrow, points);
    const auto& plan = band.plan();
    detail::PointReader<Stencil, T, D> reader;
    reader.locate(
        plan, place_.size(), [&](std::size_t q) { return place_[q].point; },
        [&](std::size_t q) { return geometry_->normal.block(place_[q].block)[place_[q].entry]; }, execution);
    std::vector<detail::GroupValues<Stencil, T, D>> values(static_cast<std::size_t>(execution.count()));
    for (auto& one : values) one.fit(plan, 1);
    reader.for_each_group(execution, [&](std::size_t w, std::size_t g, std::size_t begin, std::size_t end) {
      values[w].read(plan, plan.groups[g], c.column(species_).data());
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t q = reader.order(i);
        const auto& [block, entry, point] = place_[q];
        const T speed = static_cast<T>(rate_) * reader.stencil(plan, q).value(values[w].patch(0));
        velocity_->set(block, entry, speed * geometry_->normal.block(block)[entry]);
      }
    });
    return *velocity_;
  }

 private:
  using Normals = typename AtClosestPoints<Lambda<4, 4>>::template Method<T, D>;
  struct Place {
    std::size_t block, entry;
    Vec<D> point;  ///< the closest point of the node, in spacings
  };

  template <class L>
  BandGeometry<T, D>& geometry(const L& level_set) {
    if (!geometry_) geometry_.emplace(level_set.lattice());
    return *geometry_;
  }
  template <class Band, class Points>
  void list(const Band& narrow, const Points& points) {
    place_.clear();
    for (std::size_t b = 0; b < narrow.blocks(); ++b) {
      for (std::size_t i = 0; i < Band::volume; ++i) {
        const Index<D> node = narrow.values().node(b, i);
        if (!points.found(b, i) || !geometry_->defined(b, i) || !narrow.lattice().contains(node)) continue;
        Vec<D> point;
        for (int d = 0; d < D; ++d) {
          point[d] = static_cast<double>(node[d]) + static_cast<double>(points.offset(b, i)[d]);
        }
        place_.push_back({b, i, point});
      }
    }
  }

  double rate_;
  int species_;
  std::optional<BandVelocity<T, D>> velocity_;
  std::optional<BandGeometry<T, D>> geometry_;
  Normals normals_;
  std::vector<Place> place_;
};

/// u = -mobility kappa n, kappa the sum of the principal curvatures at the closest point. Explicit: steps of at most
/// about 0.2 h^2 / mobility. Curvatures are bounded by 1 / h: what is sharper is below the lattice, as at a pinch.
template <int D = 3, class T = double>
class CurvatureMotion {
 public:
  static constexpr bool moves = true;
  static constexpr bool coupled = true;

  explicit CurvatureMotion(double mobility = 1.0) : mobility_(mobility) {}

  template <class L, class B, class C, class E>
  const BandVelocity<T, D>& velocity(const L& level_set, const B&, const C&, const E& execution) {
    const auto& narrow = level_set.band();
    if (!velocity_) velocity_.emplace(level_set.lattice());
    if (!geometry_) geometry_.emplace(level_set.lattice());
    velocity_->fit(narrow);
    curvature_(narrow, level_set.method().points(), *geometry_, execution);
    const T most = static_cast<T>((D - 1.0) / level_set.spacing());
    for_each_piece(execution, narrow.blocks(), 1, [&](std::size_t b, std::size_t) {
      for (std::size_t i = 0; i < geometry_->mean.block(b).size(); ++i) {
        if (!geometry_->defined(b, i)) continue;
        const T kappa = std::clamp(geometry_->mean.block(b)[i], -most, most);
        velocity_->set(b, i, static_cast<T>(-mobility_) * kappa * geometry_->normal.block(b)[i]);
      }
    });
    return *velocity_;
  }

 private:
  double mobility_;
  std::optional<BandVelocity<T, D>> velocity_;
  std::optional<BandGeometry<T, D>> geometry_;
  typename AtClosestPoints<Lambda<4, 4>>::template Method<T, D> curvature_;
};

/// Checks M at compile time, one readable message for each requirement.
template <class M>
constexpr void check_surface_motion() {
  static_assert(
      requires {
        { M::moves } -> std::convertible_to<bool>;
        { M::coupled } -> std::convertible_to<bool>;
      },
      "cambium: a motion of a surface says whether it moves and whether it is coupled: static constexpr bool moves, "
      "coupled; see docs/concepts/SurfaceMotion.md");
}

}  // namespace cambium
