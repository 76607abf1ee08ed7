// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <functional>
#include <optional>

#include <cambium/levelset/geometry/at_closest_points.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/models/band_velocity.hpp>

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

/// u = -mobility kappa n, kappa the sum of the principal curvatures at the closest point. Explicit: steps of at most
/// about 0.2 h^2 / mobility. kappa is bounded by (D - 1) / h, that of a ball of radius h: what is sharper is below the
/// lattice, as at a pinch; limited() tells at how many nodes.
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
    const auto set_block = [&](std::size_t b) {
      std::size_t limited = 0;
      for (std::size_t i = 0; i < geometry_->mean.block(b).size(); ++i) {
        if (!geometry_->defined(b, i)) continue;
        const T curvature = geometry_->mean.block(b)[i], kappa = std::clamp(curvature, -most, most);
        if (kappa != curvature) ++limited;
        velocity_->set(b, i, static_cast<T>(-mobility_) * kappa * geometry_->normal.block(b)[i]);
      }
      return limited;
    };
    limited_ = reduce(execution, narrow.blocks(), std::size_t{0}, set_block, std::plus<>{});
    return *velocity_;
  }
  /// Nodes whose curvature the last velocity() limited.
  std::size_t limited() const { return limited_; }

 private:
  double mobility_;
  std::size_t limited_ = 0;
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
