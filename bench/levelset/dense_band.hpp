// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "support/exact_band.hpp"

namespace bench {

/// A band that holds values of all nodes of a lattice, in the order of the lattice, cut off at +-half_width.
template <int D>
cambium::NarrowBand<double, D> dense_band(const cambium::Lattice<D>& lattice, double half_width,
                                          const std::vector<double>& phi) {
  return support::band_of_all_nodes<double>(lattice, half_width,
                                            [&](const cambium::Index<D>& node) { return phi[lattice.number(node)]; });
}

}  // namespace bench
