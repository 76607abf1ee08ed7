// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <cambium/levelset/level_set.hpp>

namespace scenes {

/// A ball by its exact signed distance.
template <int D>
struct Sphere {
  cambium::Vec<D> centre = cambium::Vec<D>::constant(0.5);
  double radius = 0.3;

  double operator()(const cambium::Vec<D>& x) const { return cambium::norm(x - centre) - radius; }
};

/// A ball off symmetric places.
template <int D>
Sphere<D> sphere_aside() {
  Sphere<D> sphere;
  sphere.centre[0] += 0.013;
  sphere.centre[1] -= 0.007;
  return sphere;
}

/// All values of a band, block by block.
template <class L>
std::vector<typename L::Scalar> values(const L& level_set) {
  std::vector<typename L::Scalar> result;
  for (std::size_t b = 0; b < level_set.band().blocks(); ++b) {
    for (const auto phi : level_set.band().values().block(b)) result.push_back(phi);
  }
  return result;
}

/// A positive factor that varies tenfold, for a level-set function of bad scaling.
template <int D>
double tenfold(const cambium::Vec<D>& x) {
  double product = 1.0;
  for (int d = 0; d < D; ++d) product *= std::sin(6.0 * x[d] + 0.4 * d);
  return 1.0 + 4.5 * (1.0 + product);
}

/// Largest |phi - exact| over the nodes within `within` of the exact interface, in spacings.
template <class T, int D, class F>
double distance_error(const cambium::NarrowBand<T, D>& band, F&& exact, double within) {
  double worst = 0.0;
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      const auto node = band.values().node(b, i);
      if (!band.lattice().contains(node)) continue;
      const double distance = exact(band.lattice().position(node));
      if (std::abs(distance) >= within * band.spacing()) continue;
      worst = std::max(worst, std::abs(static_cast<double>(band.values().block(b)[i]) - distance));
    }
  }
  return worst / band.spacing();
}

}  // namespace scenes
