// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/core/field.hpp>
#include <cambium/models/tumour/parameters.hpp>

namespace cambium::detail {

/// -Lap p = G (c - A) at the interface, where c = 1 and nothing is dead: its value inside, and its slope along the
/// normal.
template <int D>
struct InterfaceSource {
  const TumourParameters& parameters;
  const Field<double, D>& nutrient;

  double value() const { return parameters.growth * (1.0 - parameters.apoptosis); }
  /// d/dn at a point of the interface with the outward normal n: of the parabola through c = 1 there and the nutrient
  /// two and four spacings inside, interpolated linearly. Second order.
  double slope(const Vec<D>& x, const Vec<D>& n) const {
    const double depth = 2.0 * nutrient.lattice().spacing();
    const double near = interpolated(x - depth * n), far = interpolated(x - 2.0 * depth * n);
    return parameters.growth * (3.0 - 4.0 * near + far) / (2.0 * depth);
  }

 private:
  double interpolated(const Vec<D>& x) const {
    const Lattice<D>& lattice = nutrient.lattice();
    Index<D> first;
    Vec<D> part;
    for (int d = 0; d < D; ++d) {
      const double place = (x[d] - lattice.box().lo[d]) / lattice.spacing();
      first[d] = static_cast<std::ptrdiff_t>(std::floor(place));
      part[d] = place - static_cast<double>(first[d]);
    }
    double sum = 0.0;
    for (int corner = 0; corner < 1 << D; ++corner) {
      Index<D> node;
      double weight = 1.0;
      for (int d = 0; d < D; ++d) {
        const std::ptrdiff_t upper = corner >> d & 1;
        node[d] = lattice.wrap(d, first[d] + upper);
        weight *= upper == 1 ? part[d] : 1.0 - part[d];
      }
      sum += weight * (lattice.contains(node) ? nutrient(node) : 1.0);
    }
    return sum;
  }
};

}  // namespace cambium::detail
