// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include <cambium/levelset/level_set.hpp>

namespace support {

/// A ball of radius 1/2 in the box [-1, 1]^D, away from symmetric places.
template <int D>
struct OffCentreBall {
  static constexpr double radius = 0.5;

  static cambium::Vec<D> centre() {
    cambium::Vec<D> c;
    for (int d = 0; d < D; ++d) c[d] = 0.013 * (d + 1);
    return c;
  }
  double operator()(const cambium::Vec<D>& x) const { return norm(x - centre()) - radius; }
};

/// The ball's distance times a smooth factor from 1 / root to root, where root^2 is `range`.
template <int D>
struct ScaledBall {
  double range = 1.0;

  double operator()(const cambium::Vec<D>& x) const {
    return std::pow(range, 0.5 * std::sin(2.0 * x[0] + x[1])) * OffCentreBall<D>()(x);
  }
};

template <int D>
cambium::Lattice<D> box_of_ball(int cells) {
  return cambium::Lattice<D>::bounded_box({cambium::Vec<D>::constant(-1.0), cambium::Vec<D>::constant(1.0)}, cells);
}

/// Calls f(node, phi) for every node of the lattice in the blocks of a band.
template <class T, int D, class F>
void for_each_stored(const cambium::NarrowBand<T, D>& band, F&& f) {
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      const cambium::Index<D> node = band.values().node(b, i);
      if (band.lattice().contains(node)) f(node, static_cast<double>(band.values().block(b)[i]));
    }
  }
}

/// Largest error of phi at the nodes within so many spacings of the interface of f; NaN if any value is.
template <class T, int D, class F>
double distance_error(const cambium::NarrowBand<T, D>& band, double within, F&& f) {
  double error = 0.0;
  for_each_stored(band, [&](const cambium::Index<D>& node, double phi) {
    const double exact = f(band.lattice().position(node));
    if (std::abs(exact) > within * band.spacing()) return;
    error = std::isnan(phi) ? phi : std::max(error, std::abs(phi - exact));
  });
  return error;
}

/// True if two bands have the same bits.
template <class T, int D>
bool same_bits(const cambium::NarrowBand<T, D>& a, const cambium::NarrowBand<T, D>& b) {
  if (a.blocks() != b.blocks()) return false;
  for (std::size_t k = 0; k < a.blocks(); ++k) {
    if (!(a.values().block_index(k) == b.values().block_index(k))) return false;
    if (!std::ranges::equal(a.values().block(k), b.values().block(k))) return false;
  }
  return true;
}

/// Volume inside, from a step smoothed over 1.5 spacings: off by about a fifth of a squared spacing times curvature,
/// and so by the same for bands of one interface.
template <class T, int D>
double smoothed_volume(const cambium::NarrowBand<T, D>& band) {
  double sum = 0.0;
  for (std::size_t i = 0; i < band.lattice().size(); ++i) {
    const double s = std::clamp(static_cast<double>(band(band.lattice().node(i))) / (1.5 * band.spacing()), -1.0, 1.0);
    sum += 0.5 - 0.5 * (s + std::sin(std::numbers::pi * s) / std::numbers::pi);
  }
  return sum * band.lattice().cell_volume();
}

}  // namespace support
