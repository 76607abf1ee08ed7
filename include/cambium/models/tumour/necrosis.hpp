// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <cambium/models/tumour/parameters.hpp>
#include <cambium/models/tumour/policy.hpp>
#include <cambium/models/tumour/sides.hpp>

namespace cambium {

namespace detail {

/// Share of the unit cube around 0 where n . x < distance:
///   1 / (D! n_1 ... n_D) sum over corners s of s_1 ... s_D max(0, distance + s . n / 2)^D.
/// Components below 1e-3 of the largest are raised to that, which moves the plane by less than a thousandth.
template <int D>
double share_below(Vec<D> n, double distance) {
  double largest = 0.0, reach = 0.0, scale = 1.0;
  for (int d = 0; d < D; ++d) largest = std::max(largest, n[d] = std::abs(n[d]));
  if (!(largest > 0.0)) return distance > 0.0 ? 1.0 : 0.0;
  for (int d = 0; d < D; ++d) {
    n[d] = std::max(n[d], 1e-3 * largest);
    reach += 0.5 * n[d];
    scale *= n[d] * (d + 1);
  }
  if (distance >= reach) return 1.0;
  double sum = 0.0;
  for (int corner = 0; corner < 1 << D; ++corner) {
    double place = distance, sign = 1.0;
    for (int d = 0; d < D; ++d) {
      const double s = (corner >> d) % 2 != 0 ? 1.0 : -1.0;
      place += 0.5 * s * n[d];
      sign *= s;
    }
    if (place > 0.0) sum += sign * std::pow(place, D);
  }
  return std::clamp(sum / scale, 0.0, 1.0);
}

}  // namespace detail

/// No cell dies for want of nutrient: -Lap p = G (c - A). The default; nothing of Necrosis is compiled or kept.
struct NoNecrosis {
  using Kind = tumour_kind::Necrosis;

  template <int D>
  static double source(const TumourParameters& p, const Field<double, D>& c, const NarrowBand<double, D>&,
                       std::size_t i) {
    return p.growth * (c[i] - p.apoptosis);
  }
};

/// Cells die where c < N: -Lap p = G (c - A) where c >= N, -G G_N where it is not. A cell of the lattice that the rim
/// of the core cuts takes both by their shares of its volume, which keeps the order of the pressure.
struct Necrosis {
  using Kind = tumour_kind::Necrosis;

  template <int D>
  static double source(const TumourParameters& p, const Field<double, D>& c, const NarrowBand<double, D>& band,
                       std::size_t i) {
    const double dead = share(p, c, band, i);
    return (1.0 - dead) * p.growth * (c[i] - p.apoptosis) - dead * p.growth * p.necrotic_decay;
  }
  /// Share of the cell around node number i, which is inside, that is necrotic.
  template <int D>
  static double share(const TumourParameters& p, const Field<double, D>& c, const NarrowBand<double, D>& band,
                      std::size_t i) {
    const Lattice<D>& lattice = c.lattice();
    const Index<D> node = lattice.node(i);
    Vec<D> slope;
    for (int d = 0; d < D; ++d) slope[d] = difference(c, band, node, d);
    return detail::share_below(slope, p.necrotic_limit - c[i]);
  }

 private:
  /// Change of c in a spacing along an axis, from nodes inside.
  template <int D>
  static double difference(const Field<double, D>& c, const NarrowBand<double, D>& band, const Index<D>& node, int d) {
    std::array<double, 2> change{};
    int sides = 0;
    for (const int way : {-1, 1}) {
      const Index<D> next = band.inside(node + Index<D>::unit(d, way));
      if (!(band(next) < 0.0)) continue;
      change[static_cast<std::size_t>(sides++)] = way * (c(next) - c(node));
    }
    return sides == 2 ? 0.5 * (change[0] + change[1]) : change[0];
  }
};

}  // namespace cambium
