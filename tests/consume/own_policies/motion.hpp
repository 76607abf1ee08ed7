// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/levelset/advection/backward.hpp>
#include <cambium/levelset/geometry/centred_differences.hpp>
#include <cambium/models/band_velocity.hpp>
#include <cambium/models/tumour/policy.hpp>

/// The interface goes with particles that move by V n: TumourPolicy of the kind Motion.
struct ByParticles {
  using Kind = cambium::tumour_kind::Motion;
  struct Params {};

  template <int D>
  class Method {
   public:
    Method(const cambium::Lattice<D>& lattice, const Params&) : velocity_(lattice), geometry_(lattice) {}

    template <class L>
    void operator()(L& level_set, const cambium::Field<double, D, cambium::Sparse>& speed, double t, double dt,
                    const cambium::OpenMP& execution) {
      velocity_.fit(level_set.band());
      find_geometry_(level_set.band(), geometry_, execution);
      for (std::size_t b = 0; b < speed.blocks(); ++b) {
        for (std::size_t i = 0; i < speed.block(b).size(); ++i) {
          if (geometry_.defined(b, i)) velocity_.set(b, i, speed.block(b)[i] * geometry_.normal.block(b)[i]);
        }
      }
      advection_.step(level_set, velocity_, t, dt, execution);
      level_set.reinitialise(execution);
    }

   private:
    cambium::BandVelocity<double, D> velocity_;
    cambium::BandGeometry<double, D> geometry_;
    typename cambium::CentredDifferences<2>::template Method<double, D> find_geometry_{{}};
    cambium::Backward<> advection_;
  };
};
