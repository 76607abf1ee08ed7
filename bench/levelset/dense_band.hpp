// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include <cambium/levelset/narrow_band.hpp>

namespace bench {

/// A band that holds values of all nodes of a lattice, in the order of the lattice, cut off at +-half_width.
template <int D>
cambium::NarrowBand<double, D> dense_band(const cambium::Lattice<D>& lattice, double half_width,
                                          const std::vector<double>& phi) {
  cambium::NarrowBand<double, D> band(lattice, half_width);
  const auto& grid = band.values().block_grid();
  for (std::ptrdiff_t k = 0; k < cambium::product(grid); ++k) {
    cambium::Index<D> block;
    std::ptrdiff_t rest = k;
    for (int d = 0; d < D; ++d) {
      block[d] = rest % grid[d];
      rest /= grid[d];
    }
    const std::size_t b = band.values().activate(block);
    for (std::size_t i = 0; i < band.volume; ++i) {
      const double value = phi[lattice.number(band.inside(band.values().node(b, i)))];
      band.values().block(b)[i] = std::clamp(value, -half_width, half_width);
    }
  }
  band.find_far_sides();
  return band;
}

}  // namespace bench
