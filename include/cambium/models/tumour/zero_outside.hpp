// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <cambium/interface/dirichlet.hpp>
#include <cambium/levelset/closest_point_walk.hpp>
#include <cambium/levelset/geometry/band_geometry.hpp>
#include <cambium/models/tumour/interface_source.hpp>
#include <cambium/models/tumour/policy.hpp>
#include <cambium/models/tumour/sides.hpp>
#include <cambium/models/tumour/value_at.hpp>

namespace cambium {

namespace detail {

/// Pressure inside alone, p given on the interface.
template <int D, class K>
class InsidePressure {
 public:
  using Band = NarrowBand<double, D>;
  using Values = Field<double, D, Sparse>;

  InsidePressure(const Lattice<D>& lattice, double, const OpenMP& execution)
      : execution_(execution), zero_(lattice), grown_(lattice), dropped_(lattice), part_(lattice), slope_(lattice) {}

  void attach(const Band& band, const ClosestPoints<K, double, D>& points, const BandGeometry<double, D>&) {
    if (solver_) {
      solver_->update(band);
    } else {
      solver_.emplace(band, typename Dirichlet<D>::Params{}, execution_);
    }
    band_ = &band;
    points_ = &points;
  }
  /// As JumpPressure::solve(), with p = 0 outside, in two parts: that of f with p = 0 on the interface, whose slope is
  /// taken by cubic polynomials, and that of the drop, see respond()
  void solve(Field<double, D>& f, const Values& drop, const InterfaceSource<D>&, Field<double, D>& p, Values& speed) {
    solver_->solve(
        f, [](const Vec<D>&) { return 0.0; }, grown_, CutStencil::cubic);
    find_speed(grown_, SlopeStencil::cubic, speed);
    set_outside(grown_, 0.0);
    part_ = speed;
    respond(drop, part_);
    for (std::size_t b = 0; b < speed.blocks(); ++b) {
      for (std::size_t i = 0; i < Band::volume; ++i) speed.block(b)[i] += part_.block(b)[i];
    }
    for_each(execution_, p.size(), [&](std::size_t i) { p[i] = grown_[i] + dropped_[i]; });
  }
  std::size_t unresolved() const { return solver_ ? solver_->unresolved() : 0; }
  /// The solutions are the first guesses of the next.
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive("pressure.grown", self.grown_);
    archive("pressure.dropped", self.dropped_);
  }

 private:
  /// What a drop of the pressure alone adds to the speed: Lap p = 0. Its slope is that of differences, of second order:
  /// where the drop varies from node to node, as noise does, the cubic polynomials across the interface would have
  /// slopes of the wrong sign, and the noise grow.
  void respond(const Values& drop, Values& speed) {
    solver_->solve(
        zero_, [&](const Vec<D>& x) { return value_at(drop, *band_, x); }, dropped_);
    find_speed(dropped_, SlopeStencil::differences, speed);
    set_outside(dropped_, 0.0);
  }
  void set_outside(Field<double, D>& p, double value) const {
    for_each_side(*band_, execution_, [&](std::size_t i, bool inside) {
      if (!inside) p[i] = value;
    });
  }
  /// speed := -dp/dn of the last solution, where it is not NaN.
  void find_speed(const Field<double, D>& p, SlopeStencil slopes, Values& speed) {
    solver_->normal_derivative(*band_, *points_, p, slope_, slopes);
    for (std::size_t b = 0; b < speed.blocks(); ++b) {
      for (std::size_t i = 0; i < Band::volume; ++i) {
        if (!std::isnan(speed.block(b)[i])) speed.block(b)[i] = -slope_.block(b)[i];
      }
    }
  }

  OpenMP execution_;
  const Band* band_ = nullptr;
  const ClosestPoints<K, double, D>* points_ = nullptr;
  std::optional<Dirichlet<D>> solver_;
  Field<double, D> zero_, grown_, dropped_;
  Values part_, slope_;
};

}  // namespace detail

/// p = 0 outside: there is nothing that the tumour has to push away.
struct ZeroOutside {
  using Kind = tumour_kind::Outside;
  /// Speed that a drop of the pressure with short waves causes, over their wave number.
  static constexpr double mobility = 1.0;

  template <int D, class K>
  using Method = detail::InsidePressure<D, K>;
};

}  // namespace cambium
