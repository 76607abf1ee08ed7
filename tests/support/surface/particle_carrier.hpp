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
template <int D>
using Interface = LevelSet<ClosestPoint, D>;
template <int D>
using Numbers = Field<double, D, Sparse>;

template <int D>
Interface<D> unit_sphere_in(double half_box, std::ptrdiff_t cells) {
  const auto lattice = Lattice<D>::bounded_box({Vec<D>::constant(-half_box), Vec<D>::constant(half_box)}, cells);
  return {lattice, Ball<D>(modes::centre<D>(), 1.0)};
}

/// A species on particles around an interface that moves.
template <int D>
struct Carrier {
  explicit Carrier(Interface<D>&& start) : level_set(std::move(start)), c(level_set.lattice()), spare(c) {}

  Interface<D> level_set;
  Numbers<D> c, spare;
  SurfaceParticles<1, D> particles;
  Backward<> advection{{.path_error = 1e-5}};
  typename ByClosestPoint<>::template Method<double, D> extend;
  double t = 0.0, kept = 0.0;

  template <class F>
  void sample(F&& f) {
    take_blocks(c, level_set.band());
    for_each_node(c, [&](const Index<D>& node, double& value) { value = f(level_set.lattice().position(node)); });
  }
  template <class U, Execution E = OpenMP>
  void move(U&& u, double dt, const E& execution = {}) {
    const Interface<D> before = level_set;
    particles.take(before, c, execution);
    const double total = particles.total(0);
    advection.step(level_set, u, t, dt, execution);
    level_set.reinitialise(execution);
    particles.move(before, u, t, dt, level_set, execution);
    particles.remesh(level_set, spare, execution);
    double sum = 0.0;
    for (std::size_t b = 0; b < particles.on_nodes().blocks(); ++b) {
      for (const auto& value : particles.on_nodes().block(b)) sum += value[0];
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
        if (std::abs(level_set.band().values().block(b)[i]) > level_set.spacing()) continue;
        worst = std::max(worst, std::abs(c.block(b)[i] - exact(c.lattice().position(c.node(b, i)))));
      }
    }
    return worst;
  }
};

struct Outcome {
  double error, totals;  ///< largest error of c; relative change of the sum of strengths in the worst of the steps
};

/// u = n from R = 1 to 1 + end: c = (2 + Y_10) / R^(D - 1).
template <int D, Execution E = OpenMP>
Outcome growing_sphere(std::ptrdiff_t cells, int steps, double end = 0.25, const E& execution = {}) {
  Carrier<D> carrier{unit_sphere_in<D>(2.05, cells)};
  const auto start = [](const Vec<D>& x) { return 2.0 + modes::harmonic<D>(1, x - modes::centre<D>()); };
  carrier.sample(start);
  for (int s = 0; s < steps; ++s) {
    carrier.move([](const Vec<D>& x, double) { return (x - modes::centre<D>()) / norm(x - modes::centre<D>()); },
                 end / steps, execution);
  }
  const double error = carrier.error([&](const Vec<D>& x) { return start(x) / std::pow(1.0 + end, D - 1); });
  return {error, carrier.kept};
}

}  // namespace particles
