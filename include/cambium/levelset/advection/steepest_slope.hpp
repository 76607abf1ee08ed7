// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <cambium/levelset/patch.hpp>

namespace cambium::detail {

/// Largest |grad phi| over the nodes of a band, by the steeper of the two differences along each axis.
/// \param patches  scratch, kept between calls
template <class T, int D, Execution E>
double steepest_slope(const NarrowBand<T, D>& band, std::vector<Patch<T, D>>& patches, const E& execution) {
  patches.resize(std::max(patches.size(), static_cast<std::size_t>(execution.count())));
  std::vector<double> largest(band.blocks());
  for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t w, std::size_t b, std::size_t) {
    Patch<T, D>& patch = patches[w];
    patch.read_block(band, b, 1);
    for (std::size_t i = 0; i < band.volume; ++i) {
      const std::ptrdiff_t at = patch.entry(i);
      if (!band.in_band(patch[at]) || !band.lattice().contains(band.values().node(b, i))) continue;
      double square = 0.0;
      for (int d = 0; d < D; ++d) {
        const T before = patch[at] - patch[at - patch.stride()[d]];
        const T behind = patch[at + patch.stride()[d]] - patch[at];
        square += std::pow(static_cast<double>(std::max(std::abs(before), std::abs(behind))), 2);
      }
      largest[b] = std::max(largest[b], square);
    }
  });
  double square = 0.0;
  for (const double of_block : largest) square = std::max(square, of_block);
  return std::sqrt(square) / band.spacing();
}

}  // namespace cambium::detail
