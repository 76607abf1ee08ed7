// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/models/surface_chemistry.hpp>
#include <cambium/multigrid/krylov.hpp>
#include <cambium/time/imex.hpp>

namespace cambium {

/// Steps of a SurfacePattern with implicit diffusion, by a matrix-free Krylov loop on the values of the band, and
/// explicit reaction. The matrix is 1 - dt D Lap with a condition of about 16 dt D / h^2: BiCGStab without a
/// preconditioner takes the square root of that iterations.
/// \tparam Tableau  with an error estimate
template <class Tableau = ARK3>
struct ImplicitDiffusion {
  /// Of the residual: what a step may err by is far above it.
  static constexpr double tolerance = 1e-8;

  template <class S, class E>
  using Method = IMEX<S, Tableau, E>;

  template <class C>
  static auto rhs(C& chemistry) {
    return SplitRate{[&](const auto& c, double, const auto& rate) { chemistry.reaction(c, rate); },
                     [&](const auto& c, double, const auto& rate) { chemistry.diffusion(c, rate); },
                     [&](double dt, double, const auto& right, const auto& c) { solve(chemistry, dt, right, c); }};
  }

 private:
  template <class C, class Right, class To>
  static void solve(C& chemistry, double dt, const Right& right, const To& c) {
    using T = typename To::Scalar;
    const std::size_t size = c.size();
    for (int s = 0; s < C::species; ++s) {
      const T factor = static_cast<T>(dt * chemistry.diffusivity()[s]);
      if (factor == T(0)) {
        std::ranges::copy(right.column(s), c.column(s).begin());
        continue;
      }
      const auto apply = [&](const T* in, T* out) {
        chemistry.band().laplacian(std::span<const T>(in, size), std::span<T>(out, size), chemistry.execution());
        for_each(chemistry.execution(), size, [&](std::size_t k) { out[k] = in[k] - factor * out[k]; });
      };
      const auto identity = [&](const T* in, T* out) { std::copy_n(in, size, out); };
      solve_krylov<BiCGStab, T>(apply, identity, right.column(s), c.column(s),
                                {.tolerance = tolerance, .most_iterations = 1000});
    }
  }
};

}  // namespace cambium
