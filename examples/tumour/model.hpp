// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/models/tumour.hpp>

namespace tumour {

/// Necrosis where N is positive; a policy of the program, so that one model serves both.
struct NecrosisIfAny {
  using Kind = cambium::tumour_kind::Necrosis;

  template <int D>
  static double source(const cambium::TumourParameters& p, const cambium::Field<double, D>& c,
                       const cambium::NarrowBand<double, D>& band, std::size_t i) {
    return p.necrotic_limit > 0.0 ? cambium::Necrosis::source(p, c, band, i)
                                  : cambium::NoNecrosis::source(p, c, band, i);
  }
};

template <int D, class Outside>
using Model = cambium::Tumour<D, Outside, NecrosisIfAny, cambium::SemiImplicit>;

}  // namespace tumour
