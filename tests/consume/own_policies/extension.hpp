// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/levelset/extension/extension.hpp>

/// Every node takes the value of the nearest node to its closest point, of first order: Extension.
struct ByNearestNode {
  struct Params {};
  template <class T, int D>
  class Method {
   public:
    explicit Method(const Params&) {}

    template <class V, cambium::Execution E>
    void operator()(const cambium::NarrowBand<T, D>& band, const cambium::Field<V, D, cambium::Sparse>& from,
                    cambium::Field<V, D, cambium::Sparse>& to, const E&) const {
      const auto& lattice = band.lattice();
      cambium::Field<V, D, cambium::Sparse> result = from;
      for (std::size_t b = 0; b < band.blocks(); ++b) {
        for (std::size_t i = 0; i < cambium::NarrowBand<T, D>::volume; ++i) {
          cambium::Index<D> node = band.values().node(b, i);
          cambium::Vec<D> slope;
          for (int d = 0; d < D; ++d) {
            const auto step = cambium::Index<D>::unit(d, 1);
            slope[d] = 0.5 * (band(band.inside(node + step)) - band(band.inside(node - step))) / lattice.spacing();
          }
          for (int d = 0; d < D; ++d) {
            node[d] -= std::lround(band.values().block(b)[i] * slope[d] / dot(slope, slope) / lattice.spacing());
          }
          result.block(b)[i] = from(band.inside(node));
        }
      }
      to = result;
    }
  };
};
