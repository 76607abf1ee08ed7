// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <cambium/core/columns.hpp>
#include <cambium/core/lattice.hpp>

namespace bench {

/// Interpolation as a careful user would write it: weights by calls of the kernel, each found once for each axis, nodes
/// wrapped once for each axis, loops whose length is known at run time.
template <class K, int D, class T>
class UserLoop {
 public:
  /// \param support  number of nodes under the kernel, K::support
  UserLoop(const cambium::Lattice<D>& lattice, int support) : lattice_(lattice), support_(support) {}

  /// Calls f(number of the node, weight) for every node under the kernel at x.
  template <class F>
  void for_each_node(const cambium::Vec<D, T>& x, F&& f) const {
    std::array<std::array<std::ptrdiff_t, 16>, 3> node{};
    std::array<std::array<T, 16>, 3> weight{};
    for (int d = 0; d < D; ++d) {
      const T u = x[d] / static_cast<T>(lattice_.spacing());
      const T reach = T(0.5) * static_cast<T>(support_);
      const auto first = static_cast<std::ptrdiff_t>(std::floor(u - reach)) + 1;
      const std::ptrdiff_t n = lattice_.nodes()[d];
      for (int k = 0; k < support_; ++k) {
        weight[d][k] = static_cast<T>(K::value(u - static_cast<T>(first + k)));
        node[d][k] = ((first + k) % n + n) % n;
      }
    }
    const std::ptrdiff_t row = lattice_.nodes()[0];
    const std::ptrdiff_t plane = row * lattice_.nodes()[1];
    for (int k = 0; k < (D == 3 ? support_ : 1); ++k) {
      const T along = D == 3 ? weight[2][k] : T(1);
      for (int j = 0; j < support_; ++j) {
        const T across = along * weight[1][j];
        const std::ptrdiff_t start = node[2][k] * plane + node[1][j] * row;
        for (int i = 0; i < support_; ++i) f(start + node[0][i], across * weight[0][i]);
      }
    }
  }

  void p2m(cambium::Columns<D, const T> x, const T* strength, T* mesh) const {
    for (std::size_t i = 0; i < lattice_.size(); ++i) mesh[i] = T(0);
    for (std::size_t p = 0; p < x.size(); ++p) {
      for_each_node(x[p], [&](std::ptrdiff_t i, T w) { mesh[i] += w * strength[p]; });
    }
  }
  void m2p(const T* mesh, cambium::Columns<D, const T> x, T* value) const {
    for (std::size_t p = 0; p < x.size(); ++p) {
      T sum(0);
      for_each_node(x[p], [&](std::ptrdiff_t i, T w) { sum += w * mesh[i]; });
      value[p] = sum;
    }
  }

 private:
  cambium::Lattice<D> lattice_;
  int support_;
};

}  // namespace bench
