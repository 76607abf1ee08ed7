// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/models/tumour/quasi_steady.hpp>

namespace cambium {

/// Nutrient that takes time: dc/dt = Lap c - c inside (11.61), c = 1 on the interface and outside; at rest at first.
/// Euler's implicit step, of first order: (1 + 1/dt - Lap) c = c_old / dt. Tissue that was outside at the last step had
/// c = 1 there.
struct Diffusing {
  using Kind = tumour_kind::Nutrient;

  template <int D>
  class Method {
   public:
    Method(const Lattice<D>& lattice, const OpenMP& execution)
        : at_rest_(lattice, execution), before_(lattice, 1.0), right_(lattice), execution_(execution) {}

    /// c := the nutrient `elapsed` after that of the last accept(); at rest if that is infinite.
    void solve(const NarrowBand<double, D>& band, double elapsed, Field<double, D>& c) {
      if (!std::isfinite(elapsed)) return at_rest_.solve(band, elapsed, c);
      for_each(execution_, c.size(), [&](std::size_t i) { right_[i] = before_[i] / elapsed; });
      Dirichlet<D> solver(band, {.shift = 1.0 + 1.0 / elapsed}, execution_);
      solver.solve(
          right_, [](const Vec<D>&) { return 1.0; }, c);
      detail::for_each_side(band, execution_, [&](std::size_t i, bool inside) {
        if (!inside) c[i] = 1.0;
      });
    }
    void accept(const Field<double, D>& c) { before_ = c; }

   private:
    QuasiSteady::Method<D> at_rest_;
    Field<double, D> before_;
    Field<double, D> right_;
    OpenMP execution_;
  };
};

}  // namespace cambium
