// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/levelset/narrow_band.hpp>
#include <cambium/models/tumour/parameters.hpp>
#include <cambium/models/tumour/policy.hpp>

/// Cells rest, neither growing nor dying, where the nutrient is short: TumourPolicy of the kind Necrosis.
struct Resting {
  using Kind = cambium::tumour_kind::Necrosis;

  template <int D>
  static double source(const cambium::TumourParameters& p, const cambium::Field<double, D>& c,
                       const cambium::NarrowBand<double, D>&, std::size_t i) {
    return c[i] < p.necrotic_limit ? 0.0 : p.growth * (c[i] - p.apoptosis);
  }
};
