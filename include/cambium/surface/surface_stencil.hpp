// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstddef>

#include <cambium/core/vec.hpp>
#include <cambium/kernels/remeshing_kernel.hpp>

namespace cambium {

/// What a surface band diffuses with:
///   typename S::Kernel                           interpolation at closest points: polynomial pieces, even support
///   S::reach                                     nodes that the stencil takes on either side
///   S::axes                                      a node of the stencil differs from its middle along so many axes
///   S::template row<T, D>(from, to, at, count, stride, shift)   to := (h^2 Laplacian + shift) from at `count` entries
///                                                of a row from `at` on; arrays may be read and written a vector
///                                                further
template <class S>
concept SurfaceStencil = RemeshingKernel<typename S::Kernel> &&
    requires(const double* from, double* to, const Index<3>& stride) {
  { S::reach } -> std::convertible_to<std::ptrdiff_t>;
  { S::axes } -> std::convertible_to<int>;
  S::template row<double, 3>(from, to, std::ptrdiff_t{}, std::ptrdiff_t{}, stride, 1.0);
};

/// Checks S at compile time, one readable message for each requirement.
template <class S>
constexpr void check_surface_stencil() {
  static_assert(
      requires { typename S::Kernel; },
      "cambium: a surface stencil names the kernel that interpolates at closest points, S::Kernel; see "
      "docs/concepts/SurfaceStencil.md");
  static_assert(
      requires { S::reach, S::axes; },
      "cambium: a surface stencil says what it reads: S::reach and S::axes; see docs/concepts/SurfaceStencil.md");
  static_assert(SurfaceStencil<S>,
                "cambium: a surface stencil is called as S::row<T, D>(from, to, at, count, stride, shift); see "
                "docs/concepts/SurfaceStencil.md");
}

}  // namespace cambium
