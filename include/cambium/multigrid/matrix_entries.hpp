// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <cambium/multigrid/level.hpp>

namespace cambium::detail {

/// Calls f(row, column, value) for the entries of the matrix of a level, by the numbers of its unknowns: for solvers
/// that want the matrix itself. Mirror images come as further calls with the same row and column.
template <class T, int D, class F>
void for_each_entry(const Level<T, D>& level, F&& f) {
  std::vector<std::ptrdiff_t> number(level.grid.size(), -1);
  for_each_unknown(level, Serial{},
                   [&](std::size_t at, std::size_t i) { number[at] = static_cast<std::ptrdiff_t>(i); });
  level.grid.continue_values(number.data(), Serial{});
  const auto add = [&](std::size_t at, const CutRow<T, D>& row) {
    const std::ptrdiff_t i = number[at];
    f(i, i, level.diagonal);
    for (std::size_t k = 0; k < row.leg.size(); ++k) {
      const std::ptrdiff_t step = level.grid.stride[static_cast<int>(k / 2)] * (k % 2 == 0 ? -1 : 1);
      const std::ptrdiff_t j = number[at + static_cast<std::size_t>(step)];
      if (j >= 0 && row.leg[k] != T(0)) f(i, j, -static_cast<double>(row.leg[k]));
    }
  };
  CutRow<T, D> plain{};
  plain.leg.fill(T(1));
  for (const auto& run : level.regular) {
    for (std::ptrdiff_t i = 0; i < run.count; ++i) add(run.at + static_cast<std::size_t>(i), plain);
  }
  for (const auto& rows : level.cut) {
    for (const auto& row : rows) add(row.at, row);
  }
}

}  // namespace cambium::detail
