// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <cambium/levelset/band_builder.hpp>

#include "support/ellipsoid_distance.hpp"

namespace support {

/// An ellipse or ellipsoid with exact distances, and functions whose zero set it is.
template <int D>
struct Ellipsoid {
  cambium::Vec<D> centre;
  cambium::Vec<D> semi_axes;

  /// Signed distance, < 0 inside.
  double distance(const cambium::Vec<D>& x) const { return ellipsoid_foot(x - centre, semi_axes).distance; }
  /// The distance times a smooth factor between 0.316 and 3.16.
  double scaled(const cambium::Vec<D>& x) const { return distance(x) * bad_scale(x); }
};

template <int D>
Ellipsoid<D> ellipsoid() {
  Ellipsoid<D> result{cambium::Vec<D>::constant(0.5), cambium::Vec<D>::constant(0.3)};
  result.centre[0] += 0.013;
  result.centre[1] -= 0.0071;
  result.semi_axes[0] = 0.36;
  return result;
}

/// A band with values f(x), in blocks around all nodes with |near(x)| < half width + 5 spacings; near(x) is the
/// distance or something that is not larger.
template <class T, int D, class Near, class F>
cambium::NarrowBand<T, D> make_band(const cambium::Lattice<D>& lattice, double half_width, Near&& near, F&& f) {
  cambium::NarrowBand<T, D> band(lattice, half_width);
  cambium::detail::BlockMarks<D> marks(lattice);
  const double keep = half_width + 5.0 * lattice.spacing();
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    const cambium::Index<D> node = lattice.node(k);
    if (std::abs(near(lattice.position(node))) < keep) marks.mark(node, node);
  }
  marks.for_each([&](const cambium::Index<D>& block) { band.values().activate(block); });
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      const cambium::Index<D> node = band.inside(band.values().node(b, i));
      band.values().block(b)[i] = static_cast<T>(f(lattice.position(node)));
    }
  }
  band.find_far_sides();
  return band;
}

/// Calls f(node, value) for every node of the lattice in the blocks of a band.
template <class T, int D, class F>
void for_each_value(const cambium::NarrowBand<T, D>& band, F&& f) {
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      const cambium::Index<D> node = band.values().node(b, i);
      if (band.lattice().contains(node)) f(node, band.values().block(b)[i]);
    }
  }
}

/// Largest |value - exact(x)| over the nodes with |exact(x)| < within.
template <class T, int D, class F>
double largest_error(const cambium::NarrowBand<T, D>& band, double within, F&& exact) {
  double largest = 0.0;
  for_each_value(band, [&](const auto& node, T value) {
    const double distance = exact(band.lattice().position(node));
    if (std::abs(distance) < within) largest = std::max(largest, std::abs(static_cast<double>(value) - distance));
  });
  return largest;
}

}  // namespace support
