// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/multigrid/level.hpp>

/// Jacobi's relaxation with a weight of 4/5: Smoother.
struct Jacobi {
  template <class T, int D, cambium::Execution E>
  void operator()(cambium::detail::Level<T, D>& level, bool, const E& execution) const {
    cambium::detail::find_residual(level, execution);
    const T weight = static_cast<T>(0.8 / level.diagonal);
    cambium::for_each(execution, level.unknowns.size(), [&](std::size_t k) {
      const cambium::detail::Run<D>& run = level.unknowns[k];
      for (std::ptrdiff_t i = 0; i < run.count; ++i) {
        const std::size_t at = run.at + static_cast<std::size_t>(i);
        level.x[at] += weight * level.r[at];
      }
    });
  }
};
