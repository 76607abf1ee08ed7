// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <cambium/core/columns.hpp>
#include <cambium/levelset/patch.hpp>

namespace cambium::detail {

/// Particles that start on the nodes of a narrow band, and on those within a few nodes of it, and carry phi.
template <class T, int D>
class BandParticles {
 public:
  using Band = NarrowBand<T, D>;

  /// Puts a particle on every stored node that has a node of the band within `reach` nodes along each axis.
  template <Execution E>
  void take(const Band& band, std::ptrdiff_t reach, const E& execution) {
    scratch_.resize(static_cast<std::size_t>(execution.count()));
    node_.resize(band.blocks());
    for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t w, std::size_t b, std::size_t) {
      list_block(band, b, reach, scratch_[w]);
    });
    begin_.assign(1, 0);
    for (std::size_t b = 0; b < band.blocks(); ++b) begin_.push_back(begin_.back() + node_[b].size());
    for (auto& column : x_) column.resize(begin_.back());
    phi_.resize(begin_.back());
    for_each_piece(execution, band.blocks(), 1, [&](std::size_t b, std::size_t) {
      for (std::size_t k = 0; k < node_[b].size(); ++k) {
        positions().set(begin_[b] + k, start(band, b, k));
        phi_[begin_[b] + k] = band.values().block(b)[node_[b][k]];
      }
    });
  }

  std::size_t size() const { return phi_.size(); }
  Columns<D, T> positions() {
    std::array<T*, D> first;
    for (int d = 0; d < D; ++d) first[d] = x_[d].data();
    return {first, size()};
  }
  Columns<1, const T> phi() const { return Columns<1, const T>(std::span<const T>(phi_)); }

  /// How far the lattice of the particles is from a shifted lattice: the largest difference between the displacements
  /// of two neighbours of a block, in spacings. Remeshing is exact for polynomials only where this is zero.
  template <Execution E>
  double distortion(const Band& band, const E& execution) {
    largest_.resize(band.blocks());
    for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t w, std::size_t b, std::size_t) {
      largest_[b] = distortion_of_block(band, b, scratch_[w]);
    });
    double largest = 0.0;
    for (const double of_block : largest_) largest = of_block <= largest ? largest : of_block;  // keeps NaN
    return largest;
  }

  /// Takes away the particles beyond a bounded face that are not of the band: they carry no distance. The others keep
  /// their order; distortion() is no longer known.
  void drop_far_outside(const Band& band) {
    const Domain<D>& domain = band.lattice().domain();
    std::size_t kept = 0;
    for (std::size_t p = 0; p < size(); ++p) {
      bool inside = true;
      for (int d = 0; d < D; ++d) {
        const auto x = static_cast<double>(x_[d][p]);
        inside &= domain.periodic[d] || (x >= domain.box.lo[d] && x <= domain.box.hi[d]);
      }
      if (!inside && !band.in_band(phi_[p])) continue;
      for (auto& column : x_) column[kept] = column[p];
      phi_[kept++] = phi_[p];
    }
    for (auto& column : x_) column.resize(kept);
    phi_.resize(kept);
  }

 private:
  struct Scratch {
    Patch<T, D> patch;
    std::vector<std::uint8_t> near;
    std::vector<std::uint8_t> widened;
    std::array<std::int32_t, Band::volume> particle;
  };

  Vec<D, T> start(const Band& band, std::size_t b, std::size_t k) const {
    const Vec<D> x = band.lattice().position(band.values().node(b, node_[b][k]));
    Vec<D, T> result;
    for (int d = 0; d < D; ++d) result[d] = static_cast<T>(x[d]);
    return result;
  }
  /// The nodes near the band are those of the band, widened along one axis after the other.
  void list_block(const Band& band, std::size_t b, std::ptrdiff_t reach, Scratch& scratch) {
    Patch<T, D>& patch = scratch.patch;
    patch.read_block(band, b, reach);
    const auto size = static_cast<std::size_t>(product(patch.edge()));
    scratch.near.resize(size);
    for (std::size_t at = 0; at < size; ++at) {
      scratch.near[at] = band.in_band(patch[static_cast<std::ptrdiff_t>(at)]) ? 1 : 0;
    }
    for (int d = 0; d < D; ++d) {
      scratch.widened.assign(size, 0);
      for (std::size_t at = 0; at < size; ++at) {
        if (!scratch.near[at]) continue;
        const std::ptrdiff_t stride = patch.stride()[d];
        const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(at) / stride % patch.edge()[d];
        const std::ptrdiff_t last = std::min(i + reach, patch.edge()[d] - 1);
        for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(i - reach, 0); j <= last; ++j) {
          scratch.widened[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at) + (j - i) * stride)] = 1;
        }
      }
      scratch.near.swap(scratch.widened);
    }
    node_[b].clear();
    for (std::size_t i = 0; i < Band::volume; ++i) {
      if (!scratch.near[static_cast<std::size_t>(patch.entry(i))]) continue;
      if (band.lattice().contains(band.values().node(b, i))) node_[b].push_back(static_cast<std::uint16_t>(i));
    }
  }
  double distortion_of_block(const Band& band, std::size_t b, Scratch& scratch) {
    scratch.particle.fill(-1);
    double square = 0.0;
    for (std::size_t k = 0; k < node_[b].size(); ++k) {
      const std::size_t i = node_[b][k];
      scratch.particle[i] = static_cast<std::int32_t>(k);
      const Vec<D, T> moved = positions()[begin_[b] + k] - start(band, b, k);
      std::size_t pitch = 1;
      for (int d = 0; d < D; ++d, pitch *= Band::extent) {
        if (i / pitch % Band::extent == 0 || scratch.particle[i - pitch] < 0) continue;
        const auto other = static_cast<std::size_t>(scratch.particle[i - pitch]);
        const Vec<D, T> apart = moved - (positions()[begin_[b] + other] - start(band, b, other));
        const double found = static_cast<double>(dot(apart, apart));
        square = found <= square ? square : found;
      }
    }
    return std::sqrt(square) / band.spacing();
  }

  std::array<AlignedVector<T>, D> x_;
  AlignedVector<T> phi_;
  std::vector<std::vector<std::uint16_t>> node_;
  std::vector<std::size_t> begin_;
  std::vector<double> largest_;
  std::vector<Scratch> scratch_;
};

}  // namespace cambium::detail
