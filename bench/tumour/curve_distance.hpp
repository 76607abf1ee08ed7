// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <cambium/levelset/surface.hpp>

namespace bench {

/// A closed curve by its points in order.
using Polygon = std::vector<cambium::Vec<2>>;

/// The interface of a band in the plane.
template <class Band>
std::vector<Polygon> interface_of(const Band& band) {
  const auto surface = cambium::extract_surface(band);
  std::vector<Polygon> curves;
  for (const auto& curve : cambium::closed_curves(surface)) {
    curves.emplace_back();
    for (const auto v : curve) curves.back().push_back(surface.vertices[v]);
  }
  return curves;
}

/// Distance of a point to the nearest of the curves' segments.
inline double distance_to(const std::vector<Polygon>& curves, const cambium::Vec<2>& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const Polygon& curve : curves) {
    for (std::size_t k = 0; k < curve.size(); ++k) {
      const auto a = curve[k], edge = curve[(k + 1) % curve.size()] - a;
      const double square = dot(edge, edge);
      const double at = square > 0.0 ? std::clamp(dot(x - a, edge) / square, 0.0, 1.0) : 0.0;
      least = std::min(least, norm(x - a - edge * at));
    }
  }
  return least;
}

/// The farthest that a point of one lies from the other, both ways; points are those given.
inline double hausdorff(const std::vector<Polygon>& a, const std::vector<Polygon>& b) {
  double largest = 0.0;
  for (const auto& curve : a) {
    for (const auto& x : curve) largest = std::max(largest, distance_to(b, x));
  }
  for (const auto& curve : b) {
    for (const auto& x : curve) largest = std::max(largest, distance_to(a, x));
  }
  return largest;
}

}  // namespace bench
