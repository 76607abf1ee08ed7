// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <numbers>
#include <vector>

#include <cambium/levelset/field_patch.hpp>
#include <cambium/levelset/geometry/centred_differences.hpp>
#include <cambium/surface/level_geometry.hpp>

namespace cambium {

/// The projected operator div((1 - n n) grad c) = Lap c - kappa n . grad c - n . H n, H the second derivatives of c, at
/// the nodes of a band by centred differences: surface diffusion on every level of phi, of functions that need not be
/// constant along normals (Bergdorf, Milde & Koumoutsakos, eq. 11.45, 11.54).
///
/// phi is a signed distance; normals and curvatures are those of its levels, by differences of the same order. Rates at
/// nodes whose stencils reach values that are cut off are zero: an extension must set these nodes from time to time, by
/// closest points or by a partial differential equation. SurfaceBand needs neither and is more accurate; this is what
/// it is compared with.
template <int Order, int D = 3, class T = double>
class ProjectedLaplacian {
 public:
  using Band = NarrowBand<T, D>;
  using Geometry = CentredDifferences<Order>;

  /// Takes the interface of a band: to be called when it has moved. \throws BandError if the band is too thin
  template <Execution E = OpenMP>
  void fit(const Band& band, const E& execution = {}) {
    geometry_.fit(band, 0.5 * Order * std::numbers::sqrt2 + 1.0, "the projected operator", execution);
  }
  /// to := the operator applied to `from`, both with the blocks of the band that was taken.
  /// \throws SizeError unless `from` has these blocks; ValueError if `from` and `to` are one field
  template <class V, Execution E = OpenMP>
  void operator()(const Band& band, const Field<V, D, Sparse>& from, Field<V, D, Sparse>& to, const E& execution = {}) {
    geometry_.prepare(band, from, to, "the projected operator");
    patches_.resize(std::max(patches_.size(), static_cast<std::size_t>(execution.count())));
    for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t w, std::size_t b, std::size_t) {
      Index<D> first = from.block_origin(b);
      for (int d = 0; d < D; ++d) first[d] -= reach;
      patches_[w].read(from, first, Index<D>::constant(Band::extent + 2 * reach));
      const auto values = to.block(b);
      for (std::size_t i = 0; i < Band::volume; ++i) {
        for (int c = 0; c < Components<V>::count; ++c) {
          component(values[i], c) = geometry_.get().defined(b, i) ? rate(patches_[w], b, i, c, band.spacing()) : T(0);
        }
      }
    });
  }
  const BandGeometry<T, D>& geometry() const { return geometry_.get(); }

 private:
  static constexpr std::ptrdiff_t reach = Geometry::reach;

  T rate(const FieldPatch<T, D>& patch, std::size_t b, std::size_t i, int c, double spacing) const {
    std::ptrdiff_t at = 0;
    std::size_t rest = i;
    for (int d = 0; d < D; ++d, rest /= Band::extent) {
      at += (reach + static_cast<std::ptrdiff_t>(rest % Band::extent)) * patch.stride()[d];
    }
    const Jet<T, D> jet = Geometry::jet(typename Geometry::Params{}, patch.data(c) + at, patch.stride());
    const Vec<D, T>& n = geometry_.get().normal.block(b)[i];
    const T h = static_cast<T>(spacing);
    T sum = -geometry_.get().mean.block(b)[i] * h * dot(n, jet.gradient);
    for (int d = 0; d < D; ++d) sum += jet.hessian[d][d] - n[d] * dot(jet.hessian[d], n);
    return sum / (h * h);
  }

  detail::LevelGeometry<Geometry, T, D> geometry_;
  std::vector<FieldPatch<T, D>> patches_;
};

}  // namespace cambium
