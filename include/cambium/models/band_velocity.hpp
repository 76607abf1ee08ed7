// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include <cambium/levelset/band_field.hpp>

namespace cambium {

/// A velocity that is known at the nodes of a band, between them: by cubic (Lagrange) interpolation where all its nodes
/// are known, by the linear weights of those that are elsewhere, and zero where none is, beyond the band.
template <class T, int D>
class BandVelocity {
 public:
  explicit BandVelocity(const Lattice<D>& lattice) : value_(lattice, unknown()) {}

  /// Takes the blocks of a band; all nodes are unknown then.
  void fit(const NarrowBand<T, D>& band) {
    take_blocks(value_, band);
    value_.fill(unknown());
  }
  void set(std::size_t b, std::size_t i, const Vec<D, T>& u) { value_.block(b)[i] = u; }

  /// The velocity at x; it does not depend on time.
  Vec<D, T> operator()(const Vec<D, T>& x, double) const {
    const Lattice<D>& lattice = value_.lattice();
    Index<D> cell;
    Vec<D> inside;
    for (int d = 0; d < D; ++d) {
      const double u = (static_cast<double>(x[d]) - lattice.box().lo[d]) / lattice.spacing();
      cell[d] = static_cast<std::ptrdiff_t>(std::floor(u));
      inside[d] = u - std::floor(u);
    }
    Vec<D, T> result;
    if (sum<4>(cell, inside, result) == 1.0) return result;
    const double weight = sum<2>(cell, inside, result);
    return weight > 1e-6 ? result * static_cast<T>(1.0 / weight) : Vec<D, T>{};
  }

 private:
  static Vec<D, T> unknown() { return Vec<D, T>::constant(std::numeric_limits<T>::quiet_NaN()); }

  /// Sum over the known of Support^D nodes. \return 1 if all are known (cubic), else 0; the sum of their weights
  /// (linear)
  template <int Support>
  double sum(const Index<D>& cell, const Vec<D>& inside, Vec<D, T>& result) const {
    const Lattice<D>& lattice = value_.lattice();
    std::array<std::array<double, Support>, D> weight;
    for (int d = 0; d < D; ++d) weight[static_cast<std::size_t>(d)] = weights<Support>(inside[d]);
    result = {};
    double total = 0.0;
    constexpr int count = D == 2 ? Support * Support : Support * Support * Support;
    for (int k = 0; k < count; ++k) {
      Index<D> node = cell;
      double w = 1.0;
      bool exists = true;
      for (int d = 0, rest = k; d < D; ++d, rest /= Support) {
        node[d] = lattice.wrap(d, node[d] + rest % Support - (Support / 2 - 1));
        exists &= node[d] >= 0 && node[d] < lattice.nodes()[d];
        w *= weight[static_cast<std::size_t>(d)][static_cast<std::size_t>(rest % Support)];
      }
      const Vec<D, T> u = exists ? value_(node) : unknown();
      const bool known = !std::isnan(u[0]);
      if (!known && Support == 4) return 0.0;
      if (!known) continue;
      result += static_cast<T>(w) * u;
      total += w;
    }
    return Support == 4 ? 1.0 : total;
  }
  template <int Support>
  static std::array<double, Support> weights(double x) {
    if constexpr (Support == 2) {
      return {1.0 - x, x};
    } else {
      return {-x * (x - 1.0) * (x - 2.0) / 6.0, (x + 1.0) * (x - 1.0) * (x - 2.0) / 2.0,
              -(x + 1.0) * x * (x - 2.0) / 2.0, (x + 1.0) * x * (x - 1.0) / 6.0};
    }
  }

  Field<Vec<D, T>, D, Sparse> value_;
};

}  // namespace cambium
