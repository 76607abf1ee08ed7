// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include <cambium/levelset/narrow_band.hpp>
#include <cambium/multigrid/level.hpp>

namespace cambium::detail {

/// Calls f(first node, count, inside) for pieces of rows along axis 0 that hold all nodes of the lattice of a band;
/// inside(i) says whether phi < 0 at the i-th node of the piece.
template <class T, int D, Execution E, class F>
void for_each_side_row(const NarrowBand<T, D>& band, const E& execution, F&& f) {
  constexpr std::ptrdiff_t extent = NarrowBand<T, D>::extent;
  const Index<D>& nodes = band.lattice().nodes();
  const Index<D>& blocks = band.values().block_grid();
  for_each_piece(execution, static_cast<std::size_t>(product(blocks)), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      Index<D> block, last;
      auto rest = static_cast<std::ptrdiff_t>(k);
      for (int d = 0; d < D; ++d) {
        block[d] = rest % blocks[d];
        rest /= blocks[d];
        last[d] = std::min((block[d] + 1) * extent, nodes[d]) - 1;
      }
      const std::ptrdiff_t b = band.values().find(block);
      const bool far = band.far_value(block) < T(0);
      for_each_row<D>(block * extent, last, [&](const Index<D>& row) {
        const T* const phi =
            b < 0 ? nullptr
                  : band.values().block(static_cast<std::size_t>(b)).data() + Field<T, D, Sparse>::offset(row);
        f(row, last[0] - row[0] + 1, [phi, far](std::ptrdiff_t i) { return phi ? phi[i] < T(0) : far; });
      });
    }
  });
}

}  // namespace cambium::detail
