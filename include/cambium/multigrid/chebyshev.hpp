// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

#include <cambium/multigrid/level.hpp>

namespace cambium {

/// Smoothing by the Chebyshev polynomial of degree `Degree` of A / diagonal: Jacobi steps whose weights are the inverse
/// roots of the polynomial that is least on [1/D, 2], the spectrum of waves that the next level does not have (that of
/// the (2D+1)-point Laplacian). Symmetric, and every loop runs along the lattice.
template <int Degree = 2>
struct Chebyshev {
  static_assert(Degree >= 1 && Degree <= 8, "cambium::Chebyshev: degrees 1 to 8 are free of round-off trouble");

  template <class T, int D, Execution E>
  void operator()(detail::Level<T, D>& level, bool backwards, const E& execution) const {
    for (int k = 0; k < Degree; ++k) step(level, weight<D>(backwards ? Degree - 1 - k : k), execution);
  }

 private:
  template <int D>
  static double weight(int k) {
    constexpr double low = 1.0 / D;
    constexpr double high = 2.0;
    return 1.0 / (0.5 * (high + low) + 0.5 * (high - low) * std::cos(std::numbers::pi * (k + 0.5) / Degree));
  }
  template <class T, int D, Execution E>
  static void step(detail::Level<T, D>& level, double weight, const E& execution) {
    detail::find_residual(level, execution);
    const T factor = static_cast<T>(weight / level.diagonal);
    for_each_piece(execution, level.unknowns.size(), detail::runs_per_piece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const detail::Run<D>& run = level.unknowns[k];
        T* __restrict x = level.x.data() + run.at;
        const T* const r = level.r.data() + run.at;
        for (std::ptrdiff_t i = 0; i < run.count; ++i) x[i] += factor * r[i];
      }
    });
  }
};

}  // namespace cambium
