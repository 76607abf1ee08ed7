// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include <cambium/levelset/extension/by_closest_point.hpp>
#include <cambium/parallel/nodes.hpp>
#include <cambium/surface/projected_laplacian.hpp>

#include "sphere_modes.hpp"

namespace modes {

using namespace cambium;
using Scalars = Field<double, 3, Sparse>;
using Sphere = LevelSet<ClosestPoint, 3>;

template <class F>
Scalars sampled(const Sphere& sphere, F&& f) {
  Scalars field(sphere.lattice());
  take_blocks(field, sphere.band());
  for_each_node(field, [&](const Index<3>& node, double& value) {
    const Vec<3> x = sphere.lattice().position(node) - centre<3>();
    value = norm(x) > 1e-9 ? f(x) : 0.0;
  });
  return field;
}

/// Error of Y_10 near the interface after `steps` of Euler until t = 0.1, extended after every so many of them.
template <class Extension>
double rare_extension_error(std::ptrdiff_t cells, int steps, int every) {
  const Sphere sphere = unit_sphere<3>(cells);
  const auto start = [](const Vec<3>& x) { return harmonic<3>(1, x); };
  Scalars c = sampled(sphere, start), rate(sphere.lattice());
  ProjectedLaplacian<2> projected;
  projected.fit(sphere.band());
  typename Extension::template Method<double, 3> extension;
  const double dt = 0.1 / steps;
  for (int s = 1; s <= steps; ++s) {
    projected(sphere.band(), c, rate);
    for (std::size_t b = 0; b < c.blocks(); ++b) {
      for (std::size_t i = 0; i < c.block(b).size(); ++i) c.block(b)[i] += dt * rate.block(b)[i];
    }
    if (s % every == 0) {
      extension(sphere.band(), c, rate, OpenMP{});
      std::swap(c, rate);
    }
  }
  double worst = 0.0;
  for_each_node(
      c,
      [&](const Index<3>& node, double& value) {
        const Vec<3> x = sphere.lattice().position(node) - centre<3>();
        if (std::abs(norm(x) - 1.0) > sphere.spacing()) return;
        worst = std::max(worst, std::abs(value - std::exp(-0.2) * start(x)));
      },
      Serial{});
  return worst;
}

}  // namespace modes
