// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <cambium/core/columns.hpp>
#include <cambium/core/field.hpp>
#include <cambium/parallel/execution.hpp>

namespace cambium {
namespace detail {

/// Larger of two numbers, NaN if either is.
inline double larger(double a, double b) { return a >= b || std::isnan(a) ? a : b; }

/// Node index along `axis` wrapped if the axis is periodic, held at the face if it is bounded.
template <int D>
std::ptrdiff_t inside(const Lattice<D>& lattice, int axis, std::ptrdiff_t i) {
  return lattice.periodic(axis) ? lattice.wrap(axis, i) : std::clamp<std::ptrdiff_t>(i, 0, lattice.nodes()[axis] - 1);
}

}  // namespace detail

/// Largest Euclidean norm of the vectors of particles, e.g. |u|max; NaN if any is.
template <int C, class T, Execution E = OpenMP>
double largest_norm(const Columns<C, T>& vectors, const E& execution = {}) {
  return reduce(
      execution, vectors.size(), 0.0, [&](std::size_t p) { return static_cast<double>(norm(vectors[p])); },
      detail::larger);
}

/// Largest Euclidean norm at the nodes of a vector field; NaN if any is.
template <class T, int C, int D, Execution E = OpenMP>
double largest_norm(const Field<Vec<C, T>, D>& vectors, const E& execution = {}) {
  return reduce(
      execution, vectors.size(), 0.0, [&](std::size_t i) { return static_cast<double>(norm(vectors[i])); },
      detail::larger);
}

/// Largest Frobenius norm of grad u at the nodes: a bound of the spectral norm, so strain_limit() is on the safe side.
/// Centred differences of second order, one-sided of first order at bounded faces; NaN if any value is.
template <class T, int C, int D, Execution E = OpenMP>
double largest_gradient(const Field<Vec<C, T>, D>& u, const E& execution = {}) {
  const Lattice<D>& lattice = u.lattice();
  return reduce(
      execution, u.size(), 0.0,
      [&](std::size_t i) {
        double squares = 0.0;
        for (int d = 0; d < D; ++d) {
          Index<D> left = lattice.node(i);
          Index<D> right = left;
          left[d] = detail::inside(lattice, d, left[d] - 1);
          right[d] = detail::inside(lattice, d, right[d] + 1);
          const double steps = lattice.periodic(d) ? 2.0 : static_cast<double>(right[d] - left[d]);
          const Vec<C, T> difference = u(right) - u(left);
          squares += static_cast<double>(dot(difference, difference)) / (steps * steps);
        }
        return std::sqrt(squares) / lattice.spacing();
      },
      detail::larger);
}

}  // namespace cambium
