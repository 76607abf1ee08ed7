// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/reaction/react.hpp>
#include <cambium/surface/surface_band.hpp>

namespace cambium {

/// Reaction and diffusion of several species on the interface of a surface band: dc_s/dt = F_s(c) + D_s Lap_surface
/// c_s. Refers to the band, which must live as long.
template <Kinetics K, class Stencil, int D, class T, Execution E>
class SurfaceChemistry {
 public:
  static constexpr int species = K::species;
  using Band = SurfaceBand<Stencil, D, T>;
  using Rates = Columns<species, T>;
  using Values = Columns<species, const T>;

  SurfaceChemistry(Band& band, const K& kinetics, const Vec<species>& diffusivity, const E& execution)
      : band_(&band), kinetics_(&kinetics), diffusivity_(diffusivity), execution_(execution) {}

  /// rate := F(c) + D Lap c
  void rate(const Values& c, const Rates& rate) {
    band_->laplacian(c, rate, execution_);
    react(*kinetics_, c, diffusivity_, rate, execution_);
  }
  /// rate := F(c)
  void reaction(const Values& c, const Rates& rate) { react(*kinetics_, c, Vec<species>{}, rate, execution_); }
  /// rate := D Lap c
  void diffusion(const Values& c, const Rates& rate) {
    band_->laplacian(c, rate, execution_);
    for (int s = 0; s < species; ++s) {
      const T factor = static_cast<T>(diffusivity_[s]);
      for_each(execution_, band_->size(), [&](std::size_t k) { rate.column(s)[k] *= factor; });
    }
  }
  Band& band() { return *band_; }
  const Vec<species>& diffusivity() const { return diffusivity_; }
  const E& execution() const { return execution_; }

 private:
  Band* band_;
  const K* kinetics_;
  Vec<species> diffusivity_;
  E execution_;
};

}  // namespace cambium
