// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <cambium/interface/dirichlet.hpp>
#include <cambium/models/tumour/centred_source.hpp>
#include <cambium/models/tumour/policy.hpp>
#include <cambium/models/tumour/sides.hpp>

namespace cambium {

/// Nutrient at rest: Lap c = c inside, c = 1 on the interface and outside. The solution at the last step is the first
/// guess for the next.
struct QuasiSteady {
  using Kind = tumour_kind::Nutrient;

  template <int D>
  class Method {
   public:
    Method(const Lattice<D>& lattice, const OpenMP& execution) : zero_(lattice), execution_(execution) {}

    /// c := the nutrient; holds what it was, 1 everywhere at first.
    void solve(const NarrowBand<double, D>& band, double, Field<double, D>& c) {
      if (solver_) {
        solver_->update(band);
      } else {
        solver_.emplace(band, typename Dirichlet<D>::Params{.shift = shift(band.spacing())}, execution_);
      }
      solver_->solve(
          zero_, [](const Vec<D>&) { return 1.0; }, c, CutStencil::cubic);
      detail::for_each_side(band, execution_, [&](std::size_t i, bool inside) {
        if (!inside) c[i] = 1.0;
      });
    }
    void accept(const Field<double, D>&) {}

   private:
    /// Lap c = c and Lap^2 c = c: the stencil's mean over directions is (1 + e) c, see stencil_error().
    static constexpr double shift(double spacing) { return 1.0 + detail::stencil_error<D>(spacing); }

    Field<double, D> zero_;
    OpenMP execution_;
    std::optional<Dirichlet<D>> solver_;
  };
};

}  // namespace cambium
