// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/core/field.hpp>
#include <cambium/parallel/execution.hpp>

namespace cambium::detail {

/// The centred stencil of second order is
///   Lap + h^2/12 sum of d^4/dx_d^4,  which has the mean  Lap + e Lap^2  over all directions,  e = h^2 / (4 (D + 2)).
/// Solutions of (s - Lap) u = f whose equations have e Lap^2 u on the right, too, err by waves along the lattice alone,
/// which no total feels: the mean of their slopes around a body is of fourth order inside it.
template <int D>
constexpr double stencil_error(double spacing) {
  return spacing * spacing / (4.0 * (D + 2));
}

/// Sources of -Lap p = f for that stencil: f + e Lap f. Next to the interface the second differences are those of the
/// nodes behind; parts of less than three nodes have none.
template <int D>
class CentredSource {
 public:
  explicit CentredSource(const Lattice<D>& lattice) : plain_(lattice) {}

  /// \param find_plain  find_plain(plain): writes the sources, not a number at nodes outside
  /// \param f           becomes those for the stencil, 0 outside
  template <Execution E, class F>
  void find(const E& execution, F&& find_plain, Field<double, D>& f) {
    find_plain(plain_);
    const double share = stencil_error<D>(1.0);
    for_each(execution, f.size(),
             [&](std::size_t i) { f[i] = std::isnan(plain_[i]) ? 0.0 : plain_[i] + share * laplacian(i); });
  }

 private:
  /// Times the square of the spacing.
  double laplacian(std::size_t i) const {
    const Index<D> node = plain_.lattice().node(i);
    double sum = 0.0;
    for (int d = 0; d < D; ++d) {
      const double left = at(node, d, -1), right = at(node, d, 1);
      double change = left - 2.0 * plain_[i] + right;
      if (std::isnan(left) != std::isnan(right)) {
        const std::ptrdiff_t way = std::isnan(left) ? 1 : -1;
        change = plain_[i] - 2.0 * at(node, d, way) + at(node, d, 2 * way);
      }
      if (!std::isnan(change)) sum += change;
    }
    return sum;
  }
  double at(Index<D> node, int d, std::ptrdiff_t steps) const {
    node[d] = plain_.lattice().wrap(d, node[d] + steps);
    return plain_(node);
  }

  Field<double, D> plain_;  ///< sources at nodes inside, not a number outside
};

}  // namespace cambium::detail
