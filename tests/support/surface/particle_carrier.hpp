// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <cambium/levelset/advection/backward.hpp>
#include <cambium/levelset/extension/by_closest_point.hpp>
#include <cambium/parallel/nodes.hpp>
#include <cambium/surface/surface_particles.hpp>

#include "sphere_modes.hpp"

namespace particles {

using namespace cambium;
template <int D, class T = double>
using Interface = LevelSet<ClosestPoint, D, T>;
template <int D, class T = double>
using Numbers = Field<T, D, Sparse>;

template <int D, class T = double>
Interface<D, T> unit_sphere_in(double half_box, std::ptrdiff_t cells) {
  const auto lattice = Lattice<D>::bounded_box({Vec<D>::constant(-half_box), Vec<D>::constant(half_box)}, cells);
  return {lattice, Ball<D>(modes::centre<D>(), 1.0)};
}

/// A species on particles around an interface that moves.
template <int D, class T = double, class Kernel = M6>
struct Carrier {
  explicit Carrier(Interface<D, T>&& start) : level_set(std::move(start)), c(level_set.lattice()), spare(c) {}

  Interface<D, T> level_set;
  Numbers<D, T> c, spare;
  SurfaceParticles<1, D, T, Kernel> particles;
  Backward<> advection{{.path_error = 1e-5}};
  typename ByClosestPoint<>::template Method<T, D> extend;
  double t = 0.0, kept = 0.0;

  template <class F>
  void sample(F&& f) {
    take_blocks(c, level_set.band());
    for_each_node(
        c, [&](const Index<D>& node, T& value) { value = static_cast<T>(f(level_set.lattice().position(node))); });
  }
  template <class U, Execution E = OpenMP>
  void move(U&& u, double dt, const E& execution = {}) {
    const Interface<D, T> before = level_set;
    particles.take(before, c, execution);
    const double total = particles.total(0);
    advection.step(level_set, u, t, dt, execution);
    level_set.reinitialise(execution);
    particles.move(before, u, t, dt, level_set, execution);
    particles.remesh(level_set, spare, execution);
    double sum = 0.0;
    for (std::size_t b = 0; b < particles.on_nodes().blocks(); ++b) {
      for (const auto& value : particles.on_nodes().block(b)) sum += static_cast<double>(value[0]);
    }
    kept = std::max({kept, std::abs(particles.total(0) / total - 1.0), std::abs(sum / total - 1.0)});
    extend(level_set.band(), spare, c, execution);
    t += dt;
  }
  /// The largest error next to the interface.
  template <class F>
  double error(F&& exact) {
    double worst = 0.0;
    for (std::size_t b = 0; b < c.blocks(); ++b) {
      for (std::size_t i = 0; i < c.block(b).size(); ++i) {
        if (std::abs(level_set.band().values().block(b)[i]) > static_cast<T>(level_set.spacing())) continue;
        worst =
            std::max(worst, std::abs(static_cast<double>(c.block(b)[i]) - exact(c.lattice().position(c.node(b, i)))));
      }
    }
    return worst;
  }
};

struct Outcome {
  double error, totals;  ///< largest error of c; relative change of the sum of strengths in the worst of the steps
};

/// u = n from R = 1 to 1 + end: c = (2 + Y_10) / R^(D - 1).
template <int D, class T = double, class Kernel = M6, Execution E = OpenMP>
Outcome growing_sphere(std::ptrdiff_t cells, int steps, double end = 0.25, const E& execution = {}) {
  Carrier<D, T, Kernel> carrier{unit_sphere_in<D, T>(2.05, cells)};
  Vec<D, T> centre;
  for (int d = 0; d < D; ++d) centre[d] = static_cast<T>(modes::centre<D>()[d]);
  const auto start = [](const Vec<D>& x) { return 2.0 + modes::harmonic<D>(1, x - modes::centre<D>()); };
  carrier.sample(start);
  for (int s = 0; s < steps; ++s) {
    carrier.move([&](const Vec<D, T>& x, double) { return (x - centre) / norm(x - centre); }, end / steps, execution);
  }
  const double error = carrier.error([&](const Vec<D>& x) { return start(x) / std::pow(1.0 + end, D - 1); });
  return {error, carrier.kept};
}

}  // namespace particles
