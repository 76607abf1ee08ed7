// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include <cambium/levelset/geometry/band_geometry.hpp>
#include <cambium/levelset/patch.hpp>

namespace cambium::detail {

/// Geometry from differences between nodes: Differences::jet(params, values, stride) gives the derivatives of phi at a
/// node from the nodes up to Differences::reach away along two axes at a time.
///
/// Defined where no node of the stencil may be one whose distance is cut off: |phi| < half width - sqrt(2) reach h.
template <class Differences, class T, int D>
class DifferenceGeometry {
 public:
  using Params = typename Differences::Params;

  DifferenceGeometry() = default;
  explicit DifferenceGeometry(const Params& params) : params_(params) {}

  template <Execution E>
  void operator()(const NarrowBand<T, D>& band, BandGeometry<T, D>& geometry, const E& execution) {
    geometry.take_blocks(band);
    patches_.resize(static_cast<std::size_t>(execution.count()));
    const T h = static_cast<T>(band.spacing());
    const T limit = band.half_width() - static_cast<T>(std::numbers::sqrt2 * Differences::reach) * h;
    for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
      Patch<T, D>& patch = patches_[worker];
      const auto phi = band.values().block(b);
      bool read = false;
      for (std::size_t i = 0; i < phi.size(); ++i) {
        if (!(std::abs(phi[i]) < limit) || !band.lattice().contains(band.values().node(b, i))) {
          geometry.set(b, i, {});
          continue;
        }
        if (!read) patch.read_block(band, b, Differences::reach);
        read = true;
        const Jet<T, D> jet = Differences::jet(params_, patch.data() + patch.entry(i), patch.stride());
        geometry.set(b, i, surface_geometry(jet, h));
      }
    });
  }

 private:
  Params params_;
  std::vector<Patch<T, D>> patches_;
};

}  // namespace cambium::detail
