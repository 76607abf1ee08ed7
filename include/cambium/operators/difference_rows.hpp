// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include <cambium/core/sparse.hpp>
#include <cambium/operators/difference_weights.hpp>
#include <cambium/parallel/nodes.hpp>

namespace cambium::detail {

/// One term of a differential operator: component `to` of the result gets factor * d^derivative(component `from`) along
/// `axis`, derivative 1 or 2.
struct DifferenceTerm {
  int from = 0;
  int to = 0;
  int axis = 0;
  int derivative = 1;
  double factor = 1.0;
};

template <int Order, int D>
DifferenceStencil<Order> stencil_of(const Lattice<D>& lattice, const DifferenceTerm& term, std::ptrdiff_t i) {
  const double h = lattice.spacing();
  const std::ptrdiff_t n = lattice.nodes()[term.axis];
  const bool wrap = lattice.periodic(term.axis);
  return term.derivative == 1 ? DifferenceStencil<Order>::template make<1>(i, n, wrap, term.factor / h)
                              : DifferenceStencil<Order>::template make<2>(i, n, wrap, term.factor / (h * h));
}

/// out[i] (+)= sum_k w[k] (in[k][i] - centre[i]) for i in [0, count), arrays of In or Out interleaved components.
template <int K, int In, int Out, class T>
void difference_row(const std::array<const T*, K>& in, const T* centre, const std::array<T, K>& w, std::ptrdiff_t count,
                    T* __restrict out, bool add) {
  if (add) {
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      T sum = 0;
      for (std::size_t k = 0; k < K; ++k) sum += w[k] * (in[k][i * In] - centre[i * In]);
      out[i * Out] += sum;
    }
  } else {
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      T sum = 0;
      for (std::size_t k = 0; k < K; ++k) sum += w[k] * (in[k][i * In] - centre[i * In]);
      out[i * Out] = sum;
    }
  }
}

/// The rows of nodes along axis 0 of a dense field, one component seen as an array with a stride.
template <int Order, class V, class R, int D>
class DifferenceRows {
  using T = ScalarOf<V>;
  static constexpr int in_count = Components<V>::count;
  static constexpr int out_count = Components<R>::count;
  static constexpr int half = Order / 2;

 public:
  DifferenceRows(const Field<V, D>& in, Field<R, D>& out)
      : lattice_(in.lattice()),
        n_(lattice_.nodes()[0]),
        in_(&component(*in.data(), 0)),
        out_(&component(*out.data(), 0)) {}

  /// Applies `term` along row `row`; adds to the result or sets it.
  void apply(std::size_t row, const DifferenceTerm& term, bool add) const {
    if (term.axis == 0) {
      along(row, term, add);
    } else {
      across(row, term, add);
    }
  }

 private:
  const T* in(std::size_t row, int c) const { return in_ + static_cast<std::ptrdiff_t>(row) * n_ * in_count + c; }
  T* out(std::size_t row, int c) const { return out_ + static_cast<std::ptrdiff_t>(row) * n_ * out_count + c; }

  void along(std::size_t row, const DifferenceTerm& term, bool add) const {
    const T* from = in(row, term.from);
    T* to = out(row, term.to);
    for (std::ptrdiff_t e = 0; e < 2 * half; ++e) {
      const std::ptrdiff_t i = e < half ? e : n_ - 2 * half + e;
      const auto stencil = stencil_of<Order>(lattice_, term, i);
      T sum = 0;
      for (std::size_t k = 0; k < static_cast<std::size_t>(stencil.count); ++k) {
        sum += static_cast<T>(stencil.weight[k]) * (from[stencil.node[k] * in_count] - from[i * in_count]);
      }
      to[i * out_count] = add ? to[i * out_count] + sum : sum;
    }
    const auto stencil = stencil_of<Order>(lattice_, term, half);
    std::array<const T*, Order> rows;
    std::array<T, Order> w;
    for (std::size_t k = 0; k < Order; ++k) {
      rows[k] = from + stencil.node[k] * in_count;
      w[k] = static_cast<T>(stencil.weight[k]);
    }
    difference_row<Order, in_count, out_count>(rows, from + half * in_count, w, n_ - 2 * half, to + half * out_count,
                                               add);
  }

  void across(std::size_t row, const DifferenceTerm& term, bool add) const {
    std::size_t stride = 1;
    for (int d = 1; d < term.axis; ++d) stride *= static_cast<std::size_t>(lattice_.nodes()[d]);
    const auto i = static_cast<std::ptrdiff_t>(row / stride) % lattice_.nodes()[term.axis];
    const auto stencil = stencil_of<Order>(lattice_, term, i);
    if (stencil.count == Order) {
      across_with<Order>(row, term, stride, i, stencil, add);
    } else {
      across_with<Order + 1>(row, term, stride, i, stencil, add);
    }
  }

  template <int K>
  void across_with(std::size_t row, const DifferenceTerm& term, std::size_t stride, std::ptrdiff_t i,
                   const DifferenceStencil<Order>& stencil, bool add) const {
    std::array<const T*, K> rows;
    std::array<T, K> w;
    for (std::size_t k = 0; k < K; ++k) {
      const std::ptrdiff_t shift = (stencil.node[k] - i) * static_cast<std::ptrdiff_t>(stride);
      rows[k] = in(static_cast<std::size_t>(static_cast<std::ptrdiff_t>(row) + shift), term.from);
      w[k] = static_cast<T>(stencil.weight[k]);
    }
    difference_row<K, in_count, out_count>(rows, in(row, term.from), w, n_, out(row, term.to), add);
  }

  const Lattice<D>& lattice_;
  std::ptrdiff_t n_;
  const T* in_;
  T* out_;
};

/// True if an earlier term writes the same component.
template <std::size_t N>
bool adds_to(const std::array<DifferenceTerm, N>& terms, std::size_t t) {
  for (std::size_t s = 0; s < t; ++s) {
    if (terms[s].to == terms[t].to) return true;
  }
  return false;
}

/// out := sum of the terms, for every node of a dense field, row by row.
template <int Order, class V, class R, int D, std::size_t N, Execution E>
void apply_differences(const Field<V, D, Dense>& in, const std::array<DifferenceTerm, N>& terms,
                       Field<R, D, Dense>& out, const E& execution) {
  const DifferenceRows<Order, V, R, D> rows(in, out);
  const std::size_t n = static_cast<std::size_t>(in.lattice().nodes()[0]);
  const std::size_t piece = D == 1 ? 1 : (4096 + n - 1) / n;
  for_each_piece(execution, in.size() / n, piece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      for (std::size_t t = 0; t < N; ++t) rows.apply(row, terms[t], adds_to(terms, t));
    }
  });
}

/// out := sum of the terms at the nodes of the active blocks of `in`, which become the active blocks of `out`. Nodes of
/// other blocks read as the background of `in`.
template <int Order, class V, class R, int D, std::size_t N, Execution E>
void apply_differences(const Field<V, D, Sparse>& in, const std::array<DifferenceTerm, N>& terms,
                       Field<R, D, Sparse>& out, const E& execution) {
  using T = ScalarOf<V>;
  out.clear();
  for (std::size_t b = 0; b < in.blocks(); ++b) out.activate(in.block_index(b));
  const auto at_node = [&](const Index<D>& node, R& result) {
    const V centre = in(node);
    result = R{};
    for (const auto& term : terms) {
      const auto stencil = stencil_of<Order>(in.lattice(), term, node[term.axis]);
      T sum = 0;
      for (std::size_t k = 0; k < static_cast<std::size_t>(stencil.count); ++k) {
        Index<D> other = node;
        other[term.axis] = stencil.node[k];
        sum += static_cast<T>(stencil.weight[k]) * (component(in(other), term.from) - component(centre, term.from));
      }
      component(result, term.to) += sum;
    }
  };
  for_each_node(out, at_node, execution);
}

}  // namespace cambium::detail
