// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <cambium/core/columns.hpp>
#include <cambium/levelset/field_patch.hpp>
#include <cambium/levelset/geometry/centred_differences.hpp>
#include <cambium/operators/difference_weights.hpp>

namespace cambium::detail {

/// A node of a band: its block and its number there.
struct BandNode {
  std::size_t block, node;
};

/// Volumes of particles that started on nodes of a band, from the map of their positions: the determinant of its
/// gradient by centred differences of fourth order on the lattice. Particles whose neighbours along an axis have no
/// particle keep their volume.
template <class T, int D>
class VolumeRatio {
 public:
  /// volume[p] *= det dx_p/dX. \param node  where each particle started, in the order of blocks
  template <Execution E>
  void find(const NarrowBand<T, D>& band, const std::vector<BandNode>& node, const Columns<D, const T>& x,
            AlignedVector<T>& volume, const E& execution) {
    write(band, node, x);
    begin_.assign(band.blocks() + 1, 0);
    for (const BandNode& at : node) ++begin_[at.block + 1];
    for (std::size_t b = 0; b < band.blocks(); ++b) begin_[b + 1] += begin_[b];
    patches_.resize(std::max(patches_.size(), static_cast<std::size_t>(execution.count())));
    const Index<D> edge = Index<D>::constant(NarrowBand<T, D>::extent + 2 * reach);
    for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t w, std::size_t b, std::size_t) {
      if (begin_[b] == begin_[b + 1]) return;
      patches_[w].read(*moved_, band.values().block_origin(b) - Index<D>::constant(reach), edge);
      for (std::size_t p = begin_[b]; p < begin_[b + 1]; ++p) volume[p] *= determinant(patches_[w], node[p].node);
    });
  }

 private:
  static constexpr std::ptrdiff_t reach = 2;

  /// moved := displacements in spacings, and one as the last component where there is a particle.
  void write(const NarrowBand<T, D>& band, const std::vector<BandNode>& node, const Columns<D, const T>& x) {
    if (!moved_ || !(moved_->lattice() == band.lattice())) moved_.emplace(band.lattice());
    take_blocks(*moved_, band);
    for (std::size_t b = 0; b < moved_->blocks(); ++b) {
      for (auto& value : moved_->block(b)) value = {};
    }
    for (std::size_t p = 0; p < node.size(); ++p) {
      const Vec<D> start = band.lattice().position(band.values().node(node[p].block, node[p].node));
      Vec<D> place;
      for (int d = 0; d < D; ++d) place[d] = static_cast<double>(x[p][d]);
      const Vec<D> way = band.lattice().domain().difference(start, place);
      auto& value = moved_->block(node[p].block)[node[p].node];
      for (int d = 0; d < D; ++d) value[d] = static_cast<T>(way[d] / band.spacing());
      value[D] = T(1);
    }
  }
  static T determinant(const FieldPatch<T, D>& patch, std::size_t i) {
    std::ptrdiff_t at = 0;
    for (int d = 0; d < D; ++d, i /= static_cast<std::size_t>(NarrowBand<T, D>::extent)) {
      at += (reach + static_cast<std::ptrdiff_t>(i) % NarrowBand<T, D>::extent) * patch.stride()[d];
    }
    std::array<Vec<D, T>, D> map;  // map[d]: how the positions change along axis d
    for (int d = 0; d < D; ++d) {
      const std::ptrdiff_t stride = patch.stride()[d];
      for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
        if (patch.data(D)[at + k * stride] != T(1)) return T(1);
      }
      for (int c = 0; c < D; ++c) {
        const T* u = patch.data(c) + at;
        map[d][c] = (T(8) * (u[stride] - u[-stride]) - (u[2 * stride] - u[-2 * stride])) / T(12);
      }
      map[d][d] += T(1);
    }
    if constexpr (D == 2) {
      return map[0][0] * map[1][1] - map[0][1] * map[1][0];
    } else {
      return dot(map[0], cross(map[1], map[2]));
    }
  }

  std::optional<Field<Vec<D + 1, T>, D, Sparse>> moved_;
  std::vector<std::size_t> begin_;
  std::vector<FieldPatch<T, D>> patches_;
};

}  // namespace cambium::detail
