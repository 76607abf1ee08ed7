// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include <cambium/levelset/surface.hpp>
#include <cambium/models/tumour.hpp>

namespace tumour {

/// Pressure on the inner side of the interface, at the vertices of its surface. From every node inside that is a corner
/// of the cell around a vertex, along the normal: p + phi V - phi^2 / 2 (kappa V - G (1 - A)), since dp/dn = -V and
/// Lap p = -G (1 - A) at the interface; the mean over the corners. Derivatives along the interface are left out: O(h).
template <class T>
std::vector<double> pressure_on(const T& tumour, const cambium::Surface<T::dimension>& surface) {
  constexpr int D = T::dimension;
  const auto& band = tumour.level_set().band();
  const auto& lattice = band.lattice();
  std::vector<double> result;
  result.reserve(surface.vertices.size());
  const auto& parameters = tumour.parameters();
  const double source = parameters.growth * (1.0 - parameters.apoptosis);
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    const auto& x = surface.vertices[v];
    double weights = 0.0, sum = 0.0;
    for (int corner = 0; corner < 1 << D; ++corner) {
      cambium::Index<D> node;
      double weight = 1e-6;  // one corner at least counts
      double product = 1.0;
      for (int d = 0; d < D; ++d) {
        const double u = (x[d] - lattice.box().lo[d]) / lattice.spacing();
        const auto upper = (corner >> d) % 2;
        node[d] = static_cast<std::ptrdiff_t>(std::floor(u)) + upper;
        product *= upper ? u - std::floor(u) : 1.0 - u + std::floor(u);
      }
      weight += product;
      node = band.inside(node);
      const double phi = band(node);
      const double speed = tumour.speed()(node);
      if (!(phi < 0.0) || !std::isfinite(speed)) continue;
      weights += weight;
      sum +=
          weight * (tumour.pressure()(node) + phi * speed - 0.5 * phi * phi * (surface.curvatures[v] * speed - source));
    }
    result.push_back(weights > 0.0 ? sum / weights : std::nan(""));
  }
  return result;
}

}  // namespace tumour
