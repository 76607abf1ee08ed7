// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/levelset/narrow_band.hpp>
#include <cambium/models/tumour/policy.hpp>

/// As much nutrient everywhere as outside: TumourPolicy of the kind Nutrient.
struct WellFed {
  using Kind = cambium::tumour_kind::Nutrient;

  template <int D>
  class Method {
   public:
    Method(const cambium::Lattice<D>&, const cambium::OpenMP&) {}

    void solve(const cambium::NarrowBand<double, D>&, double, cambium::Field<double, D>& c) { c.fill(1.0); }
    void accept(const cambium::Field<double, D>&) {}
  };
};
