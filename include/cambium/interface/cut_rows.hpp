// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include <cambium/interface/cut_domain.hpp>

namespace cambium::detail {

/// Coefficients of -h^2 Lap along the legs of a cut node, from quadratic polynomials through it and the two ends of its
/// legs along each axis (Shortley and Weller 1938; the quadratic ghost values of Gibou et al., J. Comput. Phys. 176
/// (2002), give the same): with lengths a and b the ends have 2 / (a (a + b)) and 2 / (b (a + b)), and the node 2 / (a
/// b). All are scaled so that the node has `diagonal`, as plain nodes have: a crossing at any distance is as good as
/// another, and at distance 0 the row says that the node has the value of the interface.
template <int D>
struct CutWeights {
  std::array<double, 2 * static_cast<std::size_t>(D)> leg{};
  double scale = 1.0;  ///< of the right-hand side

  /// \param shift  s h^2
  CutWeights(const CutNode<D>& node, double diagonal, double shift) {
    for (std::size_t k = 0; k < leg.size(); ++k) {
      if (node.leg[k] < 0.0 || node.leg[k] >= on_interface) continue;
      leg[k] = diagonal;
      scale = 0.0;
      return;
    }
    double sum = shift;
    for (std::size_t d = 0; d < D; ++d) {
      const double a = node.leg[2 * d] < 0.0 ? 1.0 : node.leg[2 * d];
      const double b = node.leg[2 * d + 1] < 0.0 ? 1.0 : node.leg[2 * d + 1];
      leg[2 * d] = 2.0 / (a * (a + b));
      leg[2 * d + 1] = 2.0 / (b * (a + b));
      sum += 2.0 / (a * b);
    }
    scale = diagonal / sum;
    for (double& weight : leg) weight *= scale;
  }

 private:
  /// Distances that change the row by no more than 1e-14 of itself.
  static constexpr double on_interface = 1e-14;
};

/// Gives a level the rows of the cut nodes of a domain.
template <class T, int D>
void take_rows(const CutDomain<D>& domain, double shift, Level<T, D>& level) {
  for (const auto& node : domain.nodes) {
    const CutWeights<D> weights(node, level.diagonal, shift);
    CutRow<T, D> row{node.at, {}};
    std::ptrdiff_t sum = 0;
    for (int d = 0; d < D; ++d) sum += node.node[d];
    for (std::size_t k = 0; k < row.leg.size(); ++k) {
      row.leg[k] = node.leg[k] < 0.0 ? static_cast<T>(weights.leg[k]) : T(0);
    }
    level.cut[static_cast<std::size_t>(sum % 2)].push_back(row);
  }
}

/// Gives a level the unknowns and rows of a domain.
template <class T, int D>
void take_domain(const CutDomain<D>& domain, double shift, Level<T, D>& level) {
  level.diagonal = 2.0 * D + shift;
  level.clear();
  const LevelGrid<D>& grid = domain.grid;
  for_each_row<D>(Index<D>{}, grid.nodes - Index<D>::constant(1), [&](const Index<D>& first) {
    Index<D> node = first;
    const std::uint8_t* const kind = domain.kind.data() + grid.at(first);
    if (std::all_of(kind, kind + grid.nodes[0], [](std::uint8_t one) { return one == beyond; })) return;
    const auto end_of = [&](std::ptrdiff_t i, auto&& belongs) {
      while (i < grid.nodes[0] && belongs(kind[i])) ++i;
      return i;
    };
    for (std::ptrdiff_t i = 0; i < grid.nodes[0];) {
      const std::ptrdiff_t end = end_of(i, [](std::uint8_t one) { return one == plain || one == cut; });
      node[0] = i;
      if (end > i) level.unknowns.push_back(make_run(grid, node, end - i, level.count));
      while (i < end) {
        node[0] = i;
        const std::ptrdiff_t stop = end_of(i, [](std::uint8_t one) { return one == plain; });
        if (stop > i) level.regular.push_back(make_run(grid, node, stop - i, level.count));
        level.count += std::max<std::ptrdiff_t>(stop - i, 1);
        i = std::max(stop, i + 1);
      }
      if (i < grid.nodes[0] && (kind[i] == beyond || kind[i] == given)) ++i;
    }
  });
  take_rows(domain, shift, level);
}

/// Gives a level the unknowns and rows of another one of the same grid, in another precision.
template <class From, class T, int D>
void take_runs(const Level<From, D>& from, Level<T, D>& level) {
  level.clear();
  level.diagonal = from.diagonal;
  level.unknowns = from.unknowns;
  level.regular = from.regular;
  level.count = from.count;
  for (std::size_t colour = 0; colour < 2; ++colour) {
    for (const auto& row : from.cut[colour]) {
      auto& to = level.cut[colour].emplace_back();
      to.at = row.at;
      for (std::size_t k = 0; k < row.leg.size(); ++k) to.leg[k] = static_cast<T>(row.leg[k]);
    }
  }
}

}  // namespace cambium::detail
