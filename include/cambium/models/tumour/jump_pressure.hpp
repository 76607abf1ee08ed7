// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/interface/jump.hpp>
#include <cambium/levelset/geometry/band_geometry.hpp>

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
/// on the whole lattice. \tparam Solver  of the second-order difference equations; \tparam Sink  -Lap p outside: fill()
/// gives f its constant value there and returns it, balance() makes what the solver gets one that has a solution
template <int D, class Solver, class K, class Sink = NoSink>
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
        drop_(lattice) {}

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
  void solve(Field<double, D>& f, const Values& drop, double source, Field<double, D>& p, Values& speed) {
    drop_ = drop;
    for (std::size_t b = 0; b < drop_.blocks(); ++b) {
      for (double& value : drop_.block(b)) value = -value;
    }
    const double step = Sink::fill(*band_, f, execution_) - source;
    jump_.set(
        drop_, NoJump{}, [step](const Vec<D>&) { return step; }, execution_);
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
  BasicJump<D, double, JumpExtension, K> jump_;
  InterfaceSides<D> sides_;
  Values drop_;
  const Band* band_ = nullptr;
  const BandGeometry<double, D>* geometry_ = nullptr;
};

}  // namespace cambium::detail
