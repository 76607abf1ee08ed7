// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

namespace bench {

/// Who compiled a plain loop: the compiler of the build, or clang++ beside it.
enum class CompiledBy { build, clang };

/// Interpolation as a plain scalar loop over particles, as good as it can be written without vector code: support and
/// dimension known at compile time, weights by Horner's rule, a raw array with ghost nodes in place of periodic ones
/// (the work of folding them is left out).
///
/// Positions are in [0, 1)^D, the lattice has n cells along each axis, axis 0 fastest. Defined in loop.cpp, which is
/// compiled once by each compiler.
template <CompiledBy compiler, class K, int D, class T>
struct PlainLoop {
  /// Nodes along an axis, ghosts included.
  static constexpr std::ptrdiff_t nodes(std::ptrdiff_t n) { return n + K::support; }

  /// mesh := sum_p strength_p W, nodes(n)^D values.
  static void p2m(const std::array<const T*, D>& x, const T* strength, std::size_t count, std::ptrdiff_t n, T* mesh);
  /// value_p := sum_i mesh_i W.
  static void m2p(const std::array<const T*, D>& x, T* value, std::size_t count, std::ptrdiff_t n, const T* mesh);
};

}  // namespace bench
