// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include <cambium/levelset/advection/backward.hpp>
#include <cambium/surface/surface_integral.hpp>
#include <cambium/surface/surface_transport.hpp>

#include "sphere_modes.hpp"

namespace motion {

using namespace cambium;
using Values = AlignedVector<double>;

/// An interface with one species on it, that moves and carries it.
template <int Order, int D>
struct Carrier {
  using Stencil = SurfaceLaplacian<Order>;
  using Band = SurfaceBand<Stencil, D>;

  explicit Carrier(LevelSet<ClosestPoint, D>&& start, bool conserved = true)
      : level_set(std::move(start)), band(level_set), transport({.conserved = conserved}), c(band.size()) {}

  LevelSet<ClosestPoint, D> level_set;
  Band band, next;
  SurfaceIntegral<Stencil, D> integral;
  Backward<> advection{{.path_error = 1e-5}};
  SurfaceTransport<Stencil, D> transport;
  Values c, carried;
  double t = 0.0;

  template <class U, Execution E = OpenMP>
  void move(U&& u, double dt, const E& execution = {}) {
    advection.step(level_set, u, t, dt, execution);
    level_set.reinitialise(execution);  // phi that a strain has left with other slopes moves the interface
    next.fit(level_set, execution);
    carried.resize(next.size());
    transport(band, c, u, t, dt, next, carried, execution);
    std::swap(band, next);
    c.swap(carried);
    t += dt;
  }
  /// \return steps taken
  template <Execution E = OpenMP>
  int diffuse(double time, const E& execution = {}) {
    const int steps = static_cast<int>(std::ceil(time * band.spectral_radius(execution) / RK4<Values>::real_axis));
    RK4<Values, E> stepper(c, execution);
    for (int s = 0; s < steps; ++s) {
      stepper.step(c, t, time / steps, [&](const Values& y, double, Values& r) { band.laplacian(y, r, execution); });
    }
    return steps;
  }
  double total() {
    integral.fit(level_set, band);
    return integral(c);
  }
  template <class F>
  double error(F&& exact) const {
    double worst = 0.0;
    for (std::size_t k = 0; k < band.size(); ++k) worst = std::max(worst, std::abs(c[k] - exact(band.point(k))));
    return worst;
  }
};

/// A unit sphere in a box of edge 2 half_box.
template <int D>
LevelSet<ClosestPoint, D> unit_sphere(double half_box, std::ptrdiff_t cells) {
  const Lattice<D> lattice = Lattice<D>::bounded_box({Vec<D>::constant(-half_box), Vec<D>::constant(half_box)}, cells);
  return {lattice, Ball<D>(modes::centre<D>(), 1.0)};
}

struct Outcome {
  double error, mass;
};

/// u = n from R = 1 to 1.25: c = (2 + Y_10) / R^(D - 1).
template <int Order, int D>
Outcome growing_sphere(std::ptrdiff_t cells, int steps) {
  const Vec<D> centre = modes::centre<D>();
  Carrier<Order, D> carrier{unit_sphere<D>(1.9, cells)};
  const auto start = [&](const Vec<D>& x) { return 2.0 + modes::harmonic<D>(1, x - centre); };
  carrier.band.sample(start, carrier.c);
  const double before = carrier.total();
  for (int s = 0; s < steps; ++s) {
    carrier.move([&](const Vec<D>& x, double) { return (x - centre) / norm(x - centre); }, 0.25 / steps);
  }
  return {carrier.error([&](const Vec<D>& x) { return start(x) / std::pow(1.25, D - 1); }),
          std::abs(carrier.total() / before - 1.0)};
}

}  // namespace motion
