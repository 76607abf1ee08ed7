// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include <cambium/interface/neumann.hpp>

#include "dirichlet_scenes.hpp"

namespace scenes {

/// A smooth function of period 1 along every axis.
template <int D>
struct Waves {
  double shift = 1.5;

  static constexpr double tau = 2.0 * std::numbers::pi;
  static double value(const Vec<D>& x) {
    double result = 1.0;
    for (int d = 0; d < D; ++d) result *= std::cos(tau * x[d] + 0.7 * d);
    return result;
  }
  static Vec<D> gradient(const Vec<D>& x) {
    Vec<D> result;
    for (int d = 0; d < D; ++d) {
      result[d] = -tau;
      for (int e = 0; e < D; ++e) result[d] *= e == d ? std::sin(tau * x[e] + 0.7 * e) : std::cos(tau * x[e] + 0.7 * e);
    }
    return result;
  }
  double right_side(const Vec<D>& x) const { return (shift + D * tau * tau) * value(x); }
};

template <int D>
NarrowBand<double, D> band_of(const Lattice<D>& lattice, const auto& shape) {
  return LevelSet<ClosestPoint, D>(lattice, shape).band();
}

/// n = grad phi / |grad phi| of a shape, by differences.
template <int D>
Vec<D> normal(const auto& shape, const Vec<D>& x) {
  Vec<D> n;
  for (int d = 0; d < D; ++d) n[d] = shape(x + Vec<D>::unit(d, 1e-5)) - shape(x - Vec<D>::unit(d, 1e-5));
  return n / norm(n);
}

/// Largest error of a Neumann problem at the nodes of its domain; where s = 0, of the solution less its mean.
template <class Flux, int D>
double neumann_error(const Lattice<D>& lattice, const auto& shape, const auto& problem, Side side = Side::inside) {
  typename Neumann<D, Flux>::Params params;
  params.side = side;
  params.shift = problem.shift;
  params.mean = MeanPart::subtract;
  Neumann<D, Flux> neumann(band_of(lattice, shape), params);
  const auto f = sample(lattice, [&](const Vec<D>& x) { return problem.right_side(x); });
  const auto exact = sample(lattice, [&](const Vec<D>& x) { return problem.value(x); });
  const double mean = problem.shift > 0.0 ? 0.0 : neumann.total(exact) / neumann.volume();
  Field<double, D> u(lattice);
  const auto report = neumann.solve(
      f, [&](const Vec<D>& x) { return dot(problem.gradient(x), normal(shape, x)); }, u);
  BOOST_TEST(report.iterations <= 25);  // measured 10 to 17, whatever the lattice
  double worst = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const Vec<D> x = lattice.position(lattice.node(i));
    if ((shape(x) < 0.0) != (side == Side::inside)) continue;
    worst = std::max(worst, std::abs(u[i] + mean - exact[i]));
  }
  return worst;
}

}  // namespace scenes
