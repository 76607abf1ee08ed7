// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/interface/jump.hpp>
#include <cambium/levelset/geometry/band_geometry.hpp>

namespace cambium::detail {

/// Pressure on both sides of the interface: -Lap p = f inside and 0 outside, p_in - p_out given, dp/dn without a jump,
/// by one solve on the whole lattice. \tparam Solver  of the second-order difference equations
template <int D, class Solver, class K>
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

  /// Takes an interface. Its geometry must live until the last solve.
  void attach(const Band& band, const ClosestPoints<K, double, D>& points, const BandGeometry<double, D>& geometry) {
    jump_.attach(band, points, execution_);
    geometry_ = &geometry;
  }
  /// \param f       -Lap p inside, 0 outside; is changed
  /// \param drop    p_in - p_out at the closest points of nodes
  /// \param source  f at the interface, inside
  /// \param speed   -dp/dn there, NaN at nodes without a closest point
  void solve(Field<double, D>& f, const Values& drop, double source, Field<double, D>& p, Values& speed) {
    drop_ = drop;
    for (std::size_t b = 0; b < drop_.blocks(); ++b) {
      for (double& value : drop_.block(b)) value = -value;
    }
    jump_.set(
        drop_, NoJump{}, [source](const Vec<D>&) { return -source; }, execution_);
    jump_.correct(f, execution_);
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
  const BandGeometry<double, D>* geometry_ = nullptr;
};

}  // namespace cambium::detail
