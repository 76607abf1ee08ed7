// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <support/manufactured.hpp>

#include <cambium/interface/dirichlet.hpp>
#include <cambium/levelset/level_set.hpp>

namespace bench {

using namespace cambium;

/// A manufactured problem inside a shape, one thread.
template <int D, class Shape>
struct Scene {
  using Problem = support::Manufactured<D>;
  Lattice<D> lattice;
  Shape shape;
  LevelSet<ClosestPoint, D> level_set;
  Field<double, D> f;

  Scene(const Lattice<D>& nodes, const Shape& form)
      : lattice(nodes),
        shape(form),
        level_set(nodes, form, {}, OpenMP{1}),
        f(sample(nodes, [](const Vec<D>& x) { return Problem{}.right_side(x); })) {}

  template <class Solver>
  double value_error(const Solver& solver, const Field<double, D>& c) const {
    double error = 0.0;
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Index<D> node = lattice.node(i);
      if (solver.in_domain(node)) error = std::max(error, std::abs(c[i] - Problem::value(lattice.position(node))));
    }
    return error;
  }
  double derivative_error(const Field<double, D, Sparse>& derivative) const {
    const auto& band = level_set.band();
    const auto& points = level_set.method().points();
    double error = 0.0;
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      for (std::size_t i = 0; i < band.volume; ++i) {
        if (!points.found(b, i)) continue;
        const Vec<D> x = lattice.position(band.values().node(b, i)) + points.offset(b, i) * lattice.spacing();
        const double exact = dot(Problem::gradient(x), normal(x));
        error = std::max(error, std::abs(derivative.block(b)[i] - exact));
      }
    }
    return error;
  }
  /// Of the shape, by differences.
  Vec<D> normal(const Vec<D>& x) const {
    Vec<D> n;
    for (int d = 0; d < D; ++d) {
      const Vec<D> step = Vec<D>::unit(d, 1e-5);
      n[d] = shape(x + step) - shape(x - step);
    }
    return n / norm(n);
  }
};

}  // namespace bench
