// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <cambium/interface/dirichlet.hpp>
#include <cambium/levelset/closest_point_walk.hpp>
#include <cambium/levelset/geometry/band_geometry.hpp>
#include <cambium/levelset/jet.hpp>
#include <cambium/models/tumour/policy.hpp>
#include <cambium/models/tumour/sides.hpp>

namespace cambium {

namespace detail {

/// Value of a field of a band at a point, interpolated by M4'.
template <int D>
double value_at(const Field<double, D, Sparse>& field, const NarrowBand<double, D>& band, const Vec<D>& x) {
  constexpr std::ptrdiff_t support = 4;
  std::array<double, static_cast<std::size_t>(D == 2 ? 16 : 64) + 16> nodes{};
  Index<D> first, stride;
  Vec<D> u;
  for (int d = 0; d < D; ++d) {
    const double place = (x[d] - band.lattice().box().lo[d]) / band.spacing();
    first[d] = static_cast<std::ptrdiff_t>(std::floor(place)) - support / 2 + 1;
    u[d] = place - static_cast<double>(first[d]);
    stride[d] = d == 0 ? 1 : stride[d - 1] * support;
  }
  for (std::ptrdiff_t k = 0; k < (D == 2 ? 16 : 64); ++k) {
    Index<D> node = first;
    for (int d = 0; d < D; ++d) node[d] += k / stride[d] % support;
    nodes[static_cast<std::size_t>(k)] = field(band.inside(node));
  }
  return Interpolant<M4Prime, double, D>::value(nodes.data(), stride, u);
}

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
  /// taken by cubic polynomials, and that of the drop, see respond(). \throws InterfaceError if the tumour is too thin
  /// for a gradient
  void solve(Field<double, D>& f, const Values& drop, double, Field<double, D>& p, Values& speed) {
    solver_->solve(
        f, [](const Vec<D>&) { return 0.0; }, grown_);
    find_speed(grown_, SlopeStencil::cubic, speed);
    set_outside(grown_, 0.0);
    part_ = speed;
    respond(drop, part_);
    for (std::size_t b = 0; b < speed.blocks(); ++b) {
      for (std::size_t i = 0; i < Band::volume; ++i) speed.block(b)[i] += part_.block(b)[i];
    }
    for_each(execution_, p.size(), [&](std::size_t i) { p[i] = grown_[i] + dropped_[i]; });
  }
  /// What a drop of the pressure alone adds to the speed: Lap p = 0. Its slope is that of differences, of second order:
  /// where the drop varies from node to node, as noise does, the cubic polynomials across the interface would have
  /// slopes of the wrong sign, and the noise grow.
  void respond(const Values& drop, Values& speed) {
    solver_->solve(
        zero_, [&](const Vec<D>& x) { return value_at(drop, *band_, x); }, dropped_);
    find_speed(dropped_, SlopeStencil::differences, speed);
    set_outside(dropped_, 0.0);
  }
  std::size_t unresolved() const { return 0; }
  /// The solutions are the first guesses of the next.
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive("pressure.grown", self.grown_);
    archive("pressure.dropped", self.dropped_);
  }

 private:
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
  static constexpr bool reaches_outside = false;

  template <int D, class K>
  using Method = detail::InsidePressure<D, K>;
};

}  // namespace cambium
