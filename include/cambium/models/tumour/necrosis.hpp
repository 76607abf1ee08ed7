// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <cambium/models/tumour/half_space.hpp>
#include <cambium/models/tumour/parameters.hpp>
#include <cambium/models/tumour/policy.hpp>
#include <cambium/models/tumour/sides.hpp>

namespace cambium {

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
/// of the core cuts has the mean of both over its volume: the rim there is the plane that touches c = N, of the
/// parabola through the nodes around. Sums of sources are of third order.
struct Necrosis {
  using Kind = tumour_kind::Necrosis;

  template <int D>
  static double source(const TumourParameters& p, const Field<double, D>& c, const NarrowBand<double, D>& band,
                       std::size_t i) {
    const Rim<D> rim = rim_of(p, c, band, i);
    const double dead = detail::cube_below<0>(rim.slope, -rim.excess);
    if (dead == 0.0) return p.growth * (c[i] - p.apoptosis);
    const double above = detail::cube_below<1>(rim.slope, rim.excess);  // mean of max(0, c - N)
    return p.growth * (above + (1.0 - dead) * (p.necrotic_limit - p.apoptosis) - dead * p.necrotic_decay);
  }
  /// Share of the cell around node number i, which is inside, that is necrotic.
  template <int D>
  static double share(const TumourParameters& p, const Field<double, D>& c, const NarrowBand<double, D>& band,
                      std::size_t i) {
    const Rim<D> rim = rim_of(p, c, band, i);
    return detail::cube_below<0>(rim.slope, -rim.excess);
  }

 private:
  /// c - N in a cell is excess + slope . x, x in spacings from its middle.
  template <int D>
  struct Rim {
    double excess;
    Vec<D> slope;
  };

  template <int D>
  static Rim<D> rim_of(const TumourParameters& p, const Field<double, D>& c, const NarrowBand<double, D>& band,
                       std::size_t i) {
    const Lattice<D>& lattice = c.lattice();
    const Index<D> node = lattice.node(i);
    Rim<D> rim{c[i] - p.necrotic_limit, {}};
    Vec<D> bend;
    bool bends = true;
    double reach = 0.0;
    for (int d = 0; d < D; ++d) {
      bends = differences(c, band, node, d, rim.slope[d], bend[d]) && bends;
      reach += 0.5 * std::abs(rim.slope[d]) + 0.25 * std::abs(bend[d]);
    }
    if (bends && std::abs(rim.excess) < reach) touch(c, band, node, bend, rim);
    return rim;
  }
  /// From c - N = excess + slope . x + x . H x / 2 to the plane in the place of its zero set: that which touches it at
  /// the point x next to the node (one step of Newton's method), moved by what the set bends away from it over a cell,
  /// (tr H - n . H n) / 24, the variance of the cube being 1/12 in every direction.
  template <int D>
  static void touch(const Field<double, D>& c, const NarrowBand<double, D>& band, const Index<D>& node,
                    const Vec<D>& bend, Rim<D>& rim) {
    const double steepness = dot(rim.slope, rim.slope);
    if (!(rim.excess * rim.excess < D * steepness)) return;  // that zero set is outside the cell
    Vec<D> change;                                           // H slope
    double trace = 0.0;
    for (int d = 0; d < D; ++d) {
      trace += bend[d];
      change[d] += bend[d] * rim.slope[d];
      for (int e = 0; e < d; ++e) {
        const std::optional<double> twist = mixed_difference(c, band, node, d, e);
        if (!twist) return;
        change[d] += *twist * rim.slope[e];
        change[e] += *twist * rim.slope[d];
      }
    }
    const double along = dot(change, rim.slope) / steepness, place = -rim.excess / steepness;  // n . H n; x over slope
    rim.excess += (trace - along) / 24.0 - 0.5 * place * place * along * steepness;
    rim.slope = rim.slope + place * change;
  }
  /// First and second difference of c along an axis. \return false if one of the neighbours is outside: then the first
  /// is that to the other, and the second 0
  template <int D>
  static bool differences(const Field<double, D>& c, const NarrowBand<double, D>& band, const Index<D>& node, int d,
                          double& first, double& second) {
    std::array<double, 2> change{};
    int sides = 0;
    for (const int way : {-1, 1}) {
      const Index<D> next = band.inside(node + Index<D>::unit(d, way));
      if (!(band(next) < 0.0)) continue;
      change[static_cast<std::size_t>(sides++)] = way * (c(next) - c(node));
    }
    first = sides == 2 ? 0.5 * (change[0] + change[1]) : change[0];
    second = sides == 2 ? change[1] - change[0] : 0.0;
    return sides == 2;
  }
  template <int D>
  static std::optional<double> mixed_difference(const Field<double, D>& c, const NarrowBand<double, D>& band,
                                                const Index<D>& node, int d, int e) {
    double sum = 0.0;
    for (const int up : {-1, 1}) {
      for (const int across : {-1, 1}) {
        const Index<D> next = band.inside(node + Index<D>::unit(d, up) + Index<D>::unit(e, across));
        if (!(band(next) < 0.0)) return {};
        sum += up * across * c(next);
      }
    }
    return 0.25 * sum;
  }
};

}  // namespace cambium
