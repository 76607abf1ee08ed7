// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <cambium/interpolation/plan_store.hpp>
#include <cambium/levelset/geometry/at_closest_points.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/models/band_velocity.hpp>
#include <cambium/surface/point_reader.hpp>
#include <cambium/surface/surface_band.hpp>

namespace cambium {

/// u = f(c, x, n) with a function of one's own of the species c (Vec<S, T>), a point x of the surface (Vec<D>) and the
/// outward normal n there (Vec<D, T>): motion by what is on the surface. Constant along normals.
///
///     const MotionBySpecies motion([](const Vec<2>& c, const Vec<3>&, const Vec<3>& n) { return (c[0] - c[1]) * n; });
///     SurfacePattern<Schnakenberg, decltype(motion)> pattern(surface, kinetics, diffusivity, motion);
template <class F, int D = 3, class T = double>
class MotionBySpecies {
 public:
  static constexpr bool moves = true;
  static constexpr bool coupled = true;

  explicit MotionBySpecies(F f) : f_(std::move(f)) {}

  template <class L, class Stencil, class C, class E>
  const BandVelocity<T, D>& velocity(const L& level_set, const SurfaceBand<Stencil, D, T>& band, const C& c,
                                     const E& execution) {
    using Species = std::remove_cvref_t<decltype(c[0])>;
    static_assert(std::is_invocable_r_v<Vec<D, T>, const F&, Species, Vec<D>, Vec<D, T>>,
                  "cambium: the velocity of a surface by its species is a function f(c, x, n) -> Vec<D, T> of the "
                  "species Vec<S, T>, a point Vec<D> and the normal Vec<D, T>");
    const auto& narrow = level_set.band();
    if (!velocity_) velocity_.emplace(level_set.lattice());
    velocity_->fit(narrow);
    if (!geometry_) geometry_.emplace(level_set.lattice());
    normals_(narrow, level_set.method().points(), *geometry_, execution);
    list(narrow, level_set.method().points());
    const auto& plan = band.plan();
    auto& reading = readings_.template get<Reading<Stencil>>(level_set.lattice());
    auto& reader = reading.reader;
    auto& values = reading.values;
    reader.locate(
        plan, place_.size(), [&](std::size_t q) { return place_[q].point; },
        [&](std::size_t q) { return geometry_->normal.block(place_[q].block)[place_[q].entry]; }, execution);
    values.resize(static_cast<std::size_t>(execution.count()));
    constexpr int species = Components<Species>::count;
    for (auto& one : values) one.fit(plan, species);
    reader.for_each_group(execution, [&](std::size_t w, std::size_t g, std::size_t begin, std::size_t end) {
      for (int s = 0; s < species; ++s) values[w].read(plan, plan.groups[g], c.column(s).data(), s);
      for (std::size_t i = begin; i < end; ++i) {
        const auto& [block, entry, point] = place_[reader.order(i)];
        const auto stencil = reader.stencil(plan, reader.order(i));
        Species here;
        for (int s = 0; s < species; ++s) here[s] = stencil.value(values[w].patch(s));
        Vec<D> x = level_set.lattice().box().lo;
        for (int d = 0; d < D; ++d) x[d] += point[d] * level_set.spacing();
        velocity_->set(block, entry, f_(here, x, geometry_->normal.block(block)[entry]));
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
  template <class Stencil>
  struct Reading {
    explicit Reading(const Lattice<D>& lattice) : engine{lattice} {}
    detail::OnLattice<D> engine;
    detail::PointReader<Stencil, T, D> reader;
    std::vector<detail::GroupValues<Stencil, T, D>> values;
  };

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

  F f_;
  std::optional<BandVelocity<T, D>> velocity_;
  std::optional<BandGeometry<T, D>> geometry_;
  Normals normals_;
  std::vector<Place> place_;
  detail::PlanStore readings_;
};

/// rate c_species n.
struct GrowthAlongNormal {
  double rate;
  int species;

  template <class C, class X, class N>
  N operator()(const C& c, const X&, const N& n) const {
    return (static_cast<ScalarOf<N>>(rate) * c[species]) * n;
  }
};

/// u = rate c_species n: the surface grows where there is much of a species (Bergdorf, Milde & Koumoutsakos, eq. 11.60,
/// with rate 1 and the first). Constant along normals.
template <int D = 3, class T = double>
class GrowthBySpecies {
 public:
  static constexpr bool moves = true;
  static constexpr bool coupled = true;

  explicit GrowthBySpecies(double rate = 1.0, int species = 0) : motion_(GrowthAlongNormal{rate, species}) {}

  template <class L, class B, class C, class E>
  const BandVelocity<T, D>& velocity(const L& level_set, const B& band, const C& c, const E& execution) {
    return motion_.velocity(level_set, band, c, execution);
  }

 private:
  MotionBySpecies<GrowthAlongNormal, D, T> motion_;
};

}  // namespace cambium
