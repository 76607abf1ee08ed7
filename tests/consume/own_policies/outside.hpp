// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/levelset/measures.hpp>
#include <cambium/models/tumour/policy.hpp>
#include <cambium/models/tumour/sides.hpp>

/// No pressure: what is gained inside pushes the interface out at the same speed everywhere, (volume / area) times the
/// mean of the sources. TumourPolicy of the kind Outside.
struct EvenGrowth {
  using Kind = cambium::tumour_kind::Outside;
  static constexpr double mobility = 0.0;  // surface tension moves nothing

  template <int D, class K>
  class Method {
   public:
    Method(const cambium::Lattice<D>&, double, const cambium::OpenMP&) {}

    template <class Points, class Geometry>
    void attach(const cambium::NarrowBand<double, D>& band, const Points&, const Geometry&) {
      band_ = &band;
    }
    template <class Source>
    void solve(const cambium::Field<double, D>& f, const cambium::Field<double, D, cambium::Sparse>&, const Source&,
               cambium::Field<double, D>& p, cambium::Field<double, D, cambium::Sparse>& speed) {
      double sum = 0.0, nodes = 0.0;
      cambium::detail::for_each_side(*band_, cambium::Serial{}, [&](std::size_t i, bool inside) {
        sum += inside ? f[i] : 0.0;
        nodes += inside ? 1.0 : 0.0;
      });
      const auto size = cambium::measures(*band_);
      for (std::size_t b = 0; b < speed.blocks(); ++b) {
        for (double& v : speed.block(b)) v = std::isnan(v) ? v : sum / nodes * size.volume / size.area;
      }
      p.fill(0.0);
    }
    std::size_t unresolved() const { return 0; }

   private:
    const cambium::NarrowBand<double, D>* band_ = nullptr;
  };
};
