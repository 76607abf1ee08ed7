// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/interface/node_sides.hpp>

namespace cambium::detail {

/// Calls f(number, inside) for every node of the lattice of a band.
template <class T, int D, Execution E, class F>
void for_each_side(const NarrowBand<T, D>& band, const E& execution, F&& f) {
  for_each_side_row(band, execution, [&](const Index<D>& row, std::ptrdiff_t count, const auto& inside) {
    const std::size_t first = band.lattice().number(row);
    for (std::ptrdiff_t i = 0; i < count; ++i) f(first + static_cast<std::size_t>(i), inside(i));
  });
}

}  // namespace cambium::detail
