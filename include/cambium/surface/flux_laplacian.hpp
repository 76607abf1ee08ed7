// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <cambium/levelset/field_patch.hpp>
#include <cambium/levelset/geometry/centred_differences.hpp>
#include <cambium/surface/level_geometry.hpp>

namespace cambium {

/// The projected operator div((1 - n n) grad c) in conservative form, for particles on the nodes of a band that
/// exchange strengths C_p = v_p c_p (Bergdorf, Milde & Koumoutsakos, eq. 11.44, 11.45 and 11.54):
///   dC_i/dt = sum over faces of h^D (F_+ - F_-) / h,   F = e_d . (1 - n n) grad c in the middle of the face
/// What one node gives through a face its neighbour receives to the last bit, so that the sum of all strengths changes
/// by round-off only; no flux leaves the nodes that have a normal. Second order, of functions that need not be constant
/// along normals. ProjectedLaplacian is the same operator without the conservation.
template <int D = 3, class T = double>
class FluxLaplacian {
 public:
  using Band = NarrowBand<T, D>;
  using Geometry = CentredDifferences<2>;

  /// Takes the interface of a band: to be called when it has moved. \throws BandError if the band is too thin
  template <Execution E = OpenMP>
  void fit(const Band& band, const E& execution = {}) {
    geometry_.fit(band, 3.0, "the flux operator", execution);
  }
  /// to := the operator applied to `from`, both with the blocks of the band that was taken: rates of c; times the
  /// volume of a particle those of its strength. \throws SizeError unless `from` has these blocks; ValueError if `from`
  /// and `to` are one field
  template <class V, Execution E = OpenMP>
  void operator()(const Band& band, const Field<V, D, Sparse>& from, Field<V, D, Sparse>& to, const E& execution = {}) {
    geometry_.prepare(band, from, to, "the flux operator");
    patches_.resize(std::max(patches_.size(), static_cast<std::size_t>(execution.count())));
    const T scale = static_cast<T>(1.0 / (band.spacing() * band.spacing()));
    for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t w, std::size_t b, std::size_t) {
      const Index<D> first = from.block_origin(b) - Index<D>::constant(1), edge = Index<D>::constant(Band::extent + 2);
      patches_[w].value.read(from, first, edge);
      patches_[w].normal.read(geometry_.get().normal, first, edge);
      const auto values = to.block(b);
      for (std::size_t i = 0; i < Band::volume; ++i) {
        for (int c = 0; c < Components<V>::count; ++c) {
          component(values[i], c) =
              geometry_.get().defined(b, i) ? scale * rate(patches_[w], from.lattice(), from.node(b, i), i, c) : T(0);
        }
      }
    });
  }

 private:
  struct Patches {
    FieldPatch<T, D> value, normal;
  };

  static T rate(const Patches& patches, const Lattice<D>& lattice, const Index<D>& node, std::size_t i, int c) {
    const Index<D>& stride = patches.value.stride();
    std::ptrdiff_t at = 0;
    std::size_t rest = i;
    for (int d = 0; d < D; ++d, rest /= Band::extent) {
      at += (1 + static_cast<std::ptrdiff_t>(rest % Band::extent)) * stride[d];
    }
    T sum{};
    for (int d = 0; d < D; ++d) {  // nothing passes a bounded face
      if (lattice.periodic(d) || node[d] + 1 < lattice.nodes()[d]) sum += flux(patches, at, d, c);
      if (lattice.periodic(d) || node[d] > 0) sum -= flux(patches, at - stride[d], d, c);
    }
    return sum;
  }
  /// h F in the middle between entry `at` and the next along axis d; zero if either has no normal.
  static T flux(const Patches& patches, std::ptrdiff_t at, int d, int c) {
    const Index<D>& stride = patches.value.stride();
    const std::ptrdiff_t next = at + stride[d];
    Vec<D, T> n;
    T here{}, there{};
    for (int e = 0; e < D; ++e) {
      const T a = patches.normal.data(e)[at], b = patches.normal.data(e)[next];
      here += a * a;
      there += b * b;
      n[e] = a + b;
    }
    if (here == T(0) || there == T(0)) return T(0);
    n /= norm(n);
    const T* value = patches.value.data(c);
    Vec<D, T> slope;
    for (int e = 0; e < D; ++e) {
      slope[e] = e == d ? value[next] - value[at]
                        : T(0.25) * ((value[at + stride[e]] - value[at - stride[e]]) +
                                     (value[next + stride[e]] - value[next - stride[e]]));
    }
    return slope[d] - n[d] * dot(n, slope);
  }

  detail::LevelGeometry<Geometry, T, D> geometry_;
  std::vector<Patches> patches_;
};

}  // namespace cambium
