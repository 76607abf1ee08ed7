// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include <cambium/core/lattice.hpp>

namespace cambium {

/// Weights w with sum_k w[k] f(node[k]) = f^(derivative)(0) for every polynomial f of degree below N.
///
/// The weight of node k is the derivative at 0 of the Lagrange polynomial prod_{j != k} (x - x_j) / (x_k - x_j), whose
/// powers are multiplied out. Number may be a floating-point type or an exact rational.
template <class Number, std::size_t N>
constexpr std::array<Number, N> difference_weights(int derivative, const std::array<int, N>& node) {
  std::array<Number, N> result{};
  for (std::size_t k = 0; k < N; ++k) {
    std::array<Number, N> power{};  // coefficients of the product so far; integers until the last division
    power[0] = Number(1);
    Number denominator(1);
    for (std::size_t j = 0; j < N; ++j) {
      if (j == k) continue;
      for (std::size_t p = N - 1; p > 0; --p) power[p] = power[p - 1] - Number(node[j]) * power[p];
      power[0] = -Number(node[j]) * power[0];
      denominator = denominator * Number(node[k] - node[j]);
    }
    Number factorial(1);
    for (int m = 2; m <= derivative; ++m) factorial = factorial * Number(m);
    result[k] = factorial * power[static_cast<std::size_t>(derivative)] / denominator;
  }
  return result;
}

/// Finite-difference weights of an even order for the first or second derivative on unit spacing.
template <int Order, int Derivative>
struct DifferenceTable {
  static_assert(Order == 2 || Order == 4 || Order == 6, "cambium: centred differences have order 2, 4 or 6");
  static_assert(Derivative == 1 || Derivative == 2, "cambium: centred differences give first or second derivatives");
  static constexpr int half = Order / 2;
  /// Nodes of a one-sided stencil of the same order.
  static constexpr int one_sided_nodes = Order + Derivative;

  /// Offsets of node `k` of a stencil of N nodes from a node that has `before` of them before it.
  template <std::size_t N>
  static constexpr std::array<int, N> offsets(int before) {
    std::array<int, N> result{};
    for (std::size_t k = 0; k < N; ++k) result[k] = static_cast<int>(k) - before;
    return result;
  }

  /// centred[k] is the weight of the node at offset k - half.
  static constexpr auto centred = difference_weights<double>(Derivative, offsets<Order + 1>(half));
  /// one_sided[i][k] is the weight of node k counted from the face, for the derivative at node i.
  static constexpr auto one_sided = [] {
    std::array<std::array<double, one_sided_nodes>, half> result{};
    for (int i = 0; i < half; ++i) {
      result[static_cast<std::size_t>(i)] = difference_weights<double>(Derivative, offsets<one_sided_nodes>(i));
    }
    return result;
  }();
};

/// Stencil of one node along one axis: the derivative is sum_k weight[k] (f[node[k]] - f[itself]).
///
/// The weight of the node itself is minus the sum of the others and not stored, so that constants give exactly zero.
template <int Order>
struct DifferenceStencil {
  static constexpr int capacity = Order + 1;
  int count = 0;
  std::array<std::ptrdiff_t, capacity> node{};
  std::array<double, capacity> weight{};

  /// \param i         node index along an axis of `nodes` nodes
  /// \param periodic  wrap around, or use one-sided stencils of the same order near the faces
  /// \param scale     multiplies every weight: sign / h^Derivative
  template <int Derivative>
  static DifferenceStencil make(std::ptrdiff_t i, std::ptrdiff_t nodes, bool periodic, double scale) {
    using Table = DifferenceTable<Order, Derivative>;
    DifferenceStencil result;
    const std::ptrdiff_t from_end = nodes - 1 - i;
    if (periodic || (i >= Table::half && from_end >= Table::half)) {
      for (int k = 0; k <= Order; ++k) {
        std::ptrdiff_t j = i + k - Table::half;
        if (j < 0) j += nodes;
        if (j >= nodes) j -= nodes;
        if (k != Table::half) result.push(j, scale * Table::centred[static_cast<std::size_t>(k)]);
      }
      return result;
    }
    const bool low = i < Table::half;
    const double sign = low || Derivative == 2 ? scale : -scale;  // mirroring changes the sign of odd derivatives
    const auto& weights = Table::one_sided[static_cast<std::size_t>(low ? i : from_end)];
    for (int k = 0; k < Table::one_sided_nodes; ++k) {
      const std::ptrdiff_t j = low ? k : nodes - 1 - k;
      if (j != i) result.push(j, sign * weights[static_cast<std::size_t>(k)]);
    }
    return result;
  }

 private:
  void push(std::ptrdiff_t j, double w) {
    node[static_cast<std::size_t>(count)] = j;
    weight[static_cast<std::size_t>(count++)] = w;
  }
};

/// \throws LatticeError unless every axis has the Order + 1 nodes of a centred stencil (periodic) or the Order + 2 of
///         a one-sided one (bounded)
template <int Order, int D>
void require_room_for_differences(const Lattice<D>& lattice) {
  for (int d = 0; d < D; ++d) {
    const int needed = Order + (lattice.periodic(d) ? 1 : 2);
    if (lattice.nodes()[d] < needed) {
      throw LatticeError(detail::message("lattice has ", lattice.nodes()[d], " nodes along axis ", d,
                                         " but differences of order ", Order, " need at least ", needed,
                                         ": refine the lattice or choose a lower order"));
    }
  }
}

}  // namespace cambium
