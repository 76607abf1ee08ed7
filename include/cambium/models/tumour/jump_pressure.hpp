// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <cambium/interface/jump.hpp>
#include <cambium/levelset/geometry/band_geometry.hpp>
#include <cambium/models/tumour/interface_source.hpp>

namespace cambium::detail {

/// What the tumour gains goes to where the solver takes it: -Lap p = 0 outside.
struct NoSink {
  template <class Band, class F, class E>
  static double fill(const Band&, F&, const E&) {
    return 0.0;
  }
  template <class Band, class F, class E>
  static void balance(const Band&, F&, const E&) {}
};

/// Pressure on both sides of the interface: -Lap p = f inside, p_in - p_out given, dp/dn without a jump, by one solve
/// on the whole lattice. \tparam Solver  of the second-order difference equations; \tparam Rule  what legs across the
/// interface are corrected by, see JumpRule; \tparam Sink  -Lap p outside: fill() gives f its constant value there and
/// returns it, balance() makes what the solver gets one that has a solution
template <int D, class Solver, class K, class Rule = JumpExtension, class Sink = NoSink>
class JumpPressure {
 public:
  using Band = NarrowBand<double, D>;
  using Values = Field<double, D, Sparse>;

  template <class... Options>
  JumpPressure(const Lattice<D>& lattice, double reach, const OpenMP& execution, const Options&... options)
      : execution_(execution),
        solver_(lattice, options..., execution),
        jump_(lattice, {.unresolved = UnresolvedLegs::keep, .reach = reach}),
        sides_(lattice),
        drop_(lattice),
        step_(lattice) {}

  /// Takes an interface. It and its geometry must live until the last solve.
  void attach(const Band& band, const ClosestPoints<K, double, D>& points, const BandGeometry<double, D>& geometry) {
    jump_.attach(band, points, execution_);
    band_ = &band;
    geometry_ = &geometry;
  }
  /// \param f       -Lap p inside; is changed
  /// \param drop    p_in - p_out at the closest points of nodes
  /// \param source  f at the interface, inside
  /// \param speed   -dp/dn there, NaN at nodes without a closest point
  void solve(Field<double, D>& f, const Values& drop, const InterfaceSource<D>& source, Field<double, D>& p,
             Values& speed) {
    drop_ = drop;
    for (std::size_t b = 0; b < drop_.blocks(); ++b) {
      for (double& value : drop_.block(b)) value = -value;
    }
    find_step(Sink::fill(*band_, f, execution_), source, speed);
    jump_.set(drop_, NoJump{}, step_, execution_);
    jump_.correct(f, execution_);
    Sink::balance(*band_, f, execution_);
    solver_.solve(f, p);
    jump_.at_interface(p, sides_, execution_);
    for_each_speed(speed, [&](std::size_t b, std::size_t i) {
      return -dot(sides_.gradient_inside.block(b)[i], geometry_->normal.block(b)[i]);
    });
  }
  /// Legs of stencils that two parts of the interface cross: it is about to touch itself there.
  std::size_t unresolved() const { return jump_.unresolved(); }

 private:
  /// step_ := [f] + s / 3 (d[f]/dn - kappa [f]) at distance s. Jump takes s^2 / 2 [f] off the interface; with that in
  /// its place the third derivative of the pressure's jump is in it, too (of the growth's part: [p] = [dp/dn] = 0).
  /// Without, sheets of sources of h^2/12 times it would lie along the interface. \param outside  f there
  void find_step(double outside, const InterfaceSource<D>& source, const Values& speed) {
    take_blocks(step_, *band_);
    const double step = outside - source.value();
    const double bound = 1.0 / band_->spacing();
    for_each_piece(execution_, band_->blocks(), 1, [&](std::size_t b, std::size_t) {
      for (std::size_t i = 0; i < Band::volume; ++i) {
        step_.block(b)[i] = step;
        if (std::isnan(speed.block(b)[i])) continue;
        const Vec<D>& normal = geometry_->normal.block(b)[i];
        const double distance = band_->values().block(b)[i];
        const double curvature = std::clamp(geometry_->mean.block(b)[i], -bound, bound);
        const double slope =
            source.slope(band_->lattice().position(band_->values().node(b, i)) - distance * normal, normal);
        step_.block(b)[i] -= distance / 3.0 * (slope + curvature * step);
      }
    });
  }
  template <class F>
  void for_each_speed(Values& speed, F&& f) const {
    for (std::size_t b = 0; b < speed.blocks(); ++b) {
      for (std::size_t i = 0; i < Band::volume; ++i) {
        if (!std::isnan(speed.block(b)[i])) speed.block(b)[i] = f(b, i);
      }
    }
  }

  OpenMP execution_;
  Solver solver_;
  BasicJump<D, double, Rule, K> jump_;
  InterfaceSides<D> sides_;
  Values drop_, step_;
  const Band* band_ = nullptr;
  const BandGeometry<double, D>* geometry_ = nullptr;
};

}  // namespace cambium::detail
