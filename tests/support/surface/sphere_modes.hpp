// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/core/lattice.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/shapes/ball.hpp>

namespace modes {

/// Off the lattice's symmetries.
template <int D>
cambium::Vec<D> centre() {
  cambium::Vec<D> c;
  for (int d = 0; d < D; ++d) c[d] = 0.013 - 0.011 * d;
  return c;
}

/// A box of edge 3.2 around the unit sphere.
template <int D>
cambium::Lattice<D> lattice(std::ptrdiff_t cells) {
  using cambium::Vec;
  return cambium::Lattice<D>::bounded_box({Vec<D>::constant(-1.6), Vec<D>::constant(1.6)}, cells);
}

template <int D>
cambium::LevelSet<cambium::ClosestPoint, D> unit_sphere(std::ptrdiff_t cells) {
  return {lattice<D>(cells), cambium::Ball<D>(centre<D>(), 1.0)};
}

/// An eigenfunction of degree l = 1, 2 or 3 of the surface Laplacian of spheres around the origin: Y_10 or, for l = 3,
/// Y_32; cos(l theta) in 2D.
template <int D>
double harmonic(int l, cambium::Vec<D> x) {
  x /= norm(x);
  if constexpr (D == 2) {
    return std::cos(l * std::atan2(x[1], x[0]));
  } else {
    if (l == 1) return x[2];
    return l == 2 ? x[0] * x[1] : (x[0] * x[0] - x[1] * x[1]) * x[2];
  }
}

/// l (l + D - 2): the surface Laplacian is minus that times the function.
template <int D>
constexpr double eigenvalue(int l) {
  return l * (l + D - 2.0);
}

}  // namespace modes
