// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include <cambium/core/columns.hpp>
#include <cambium/core/sparse.hpp>
#include <cambium/interpolation/axis.hpp>

namespace cambium::plain {

/// Nodes and weights of one particle along one axis, with nodes beyond a bounded face replaced by extrapolation.
template <RemeshingKernel K>
struct AxisStencil {
  static constexpr int capacity = K::support * (K::moments + 2);
  int count = 0;
  std::array<std::ptrdiff_t, capacity> node;
  std::array<double, capacity> weight;

  template <int D>
  AxisStencil(const Lattice<D>& lattice, int axis, double x) {
    const auto [cell, g] = detail::AxisLocator<K, double>(lattice, axis)(x);
    double w[K::support];
    Taps<K>::weights(g, w);
    for (int k = 0; k < K::support; ++k) add(lattice, axis, cell - Taps<K>::before + k, w[k]);
  }

 private:
  template <int D>
  void add(const Lattice<D>& lattice, int axis, std::ptrdiff_t i, double w) {
    const std::ptrdiff_t n = lattice.nodes()[axis];
    if (lattice.periodic(axis) || (i >= 0 && i < n)) {
      push(lattice.wrap(axis, i), w);
      return;
    }
    for (int j = 0; j <= K::moments; ++j) {
      const int outside = static_cast<int>(i < 0 ? i : n - 1 - i);
      push(i < 0 ? j : n - 1 - j, w * detail::extrapolation_weight(outside, j, K::moments));
    }
  }
  void push(std::ptrdiff_t i, double w) {
    node[count] = i;
    weight[count++] = w;
  }
};

/// Calls f(node, weight) for every node under kernel K at x.
template <RemeshingKernel K, int D, class F>
void for_each_tap(const Lattice<D>& lattice, const Vec<D>& x, F&& f) {
  std::array<AxisStencil<K>, 3> axis{AxisStencil<K>(lattice, 0, x[0]), AxisStencil<K>(lattice, D > 1 ? 1 : 0, x[D > 1]),
                                     AxisStencil<K>(lattice, D > 2 ? 2 : 0, x[D > 2 ? 2 : 0])};
  Index<3> i;
  for (i[2] = 0; i[2] < (D > 2 ? axis[2].count : 1); ++i[2]) {
    for (i[1] = 0; i[1] < (D > 1 ? axis[1].count : 1); ++i[1]) {
      for (i[0] = 0; i[0] < axis[0].count; ++i[0]) {
        Index<D> node;
        double w = 1.0;
        for (int d = 0; d < D; ++d) {
          node[d] = axis[d].node[i[d]];
          w *= axis[d].weight[i[d]];
        }
        f(node, w);
      }
    }
  }
}

/// Plain loop over particles: mesh := sum_p strength_p W(x - x_p). The reference that the fast path is held against.
template <RemeshingKernel K, int D, class P, int C, class T, class V>
void p2m(Columns<D, const P> x, Columns<C, const T> strength, Field<V, D, Dense>& mesh) {
  mesh.fill(V{});
  for (std::size_t p = 0; p < x.size(); ++p) {
    Vec<D> at;
    for (int d = 0; d < D; ++d) at[d] = x[p][d];
    for_each_tap<K>(mesh.lattice(), at, [&](const Index<D>& node, double w) {
      for (int c = 0; c < C; ++c) component(mesh(node), c) += static_cast<T>(w * strength[p][c]);
    });
  }
}

/// Plain loop over particles: value_p := sum_i mesh_i W(x_i - x_p).
template <RemeshingKernel K, int D, class P, int C, class T, class V, class S>
void m2p(const Field<V, D, S>& mesh, Columns<D, const P> x, Columns<C, T> value) {
  for (std::size_t p = 0; p < x.size(); ++p) {
    Vec<D> at;
    for (int d = 0; d < D; ++d) at[d] = x[p][d];
    Vec<C, double> sum;
    for_each_tap<K>(mesh.lattice(), at, [&](const Index<D>& node, double w) {
      for (int c = 0; c < C; ++c) sum[c] += w * component(mesh(node), c);
    });
    for (int c = 0; c < C; ++c) value.column(c)[p] = static_cast<T>(sum[c]);
  }
}

}  // namespace cambium::plain
