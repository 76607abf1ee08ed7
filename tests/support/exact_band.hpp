// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include <cambium/levelset/narrow_band.hpp>

namespace support {

/// A band with all blocks of the lattice that holds f(node), cut off at +-half_width, without any reinitialisation.
template <class T, int D, class F>
cambium::NarrowBand<T, D> band_of_all_nodes(const cambium::Lattice<D>& lattice, double half_width, F&& f) {
  cambium::NarrowBand<T, D> band(lattice, half_width);
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
      const double phi = f(band.inside(band.values().node(b, i)));
      band.values().block(b)[i] = std::clamp(static_cast<T>(phi), -band.half_width(), band.half_width());
    }
  }
  band.find_far_sides();
  return band;
}

/// The same with f of the position.
template <class T, int D, class F>
cambium::NarrowBand<T, D> exact_band(const cambium::Lattice<D>& lattice, double half_width, F&& f) {
  return band_of_all_nodes<T>(lattice, half_width,
                              [&](const cambium::Index<D>& node) { return f(lattice.position(node)); });
}

}  // namespace support
