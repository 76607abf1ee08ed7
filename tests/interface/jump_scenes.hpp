// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <cambium/interface/jump.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/levelset/shapes/torus.hpp>
#include <cambium/poisson.hpp>

/// Solutions that jump across shapes in the periodic unit box, and what a solver makes of them.
namespace scenes {

using cambium::Vec;

/// p = prod_d sin(2 pi x_d + s_d) outside and 0.8 exp(k . x) inside: nothing that jumps is constant or zero.
template <int D>
struct ProductAndExponential {
  static double phase(const Vec<D>& x, int d) { return 2.0 * std::numbers::pi * x[d] + 0.3 + 0.7 * d; }
  static Vec<D> k() {
    constexpr double all[3] = {1.5, -1.1, 0.8};
    Vec<D> result;
    for (int d = 0; d < D; ++d) result[d] = all[d];
    return result;
  }
  static double value(bool inside, const Vec<D>& x) {
    if (inside) return 0.8 * std::exp(dot(k(), x));
    double product = 1.0;
    for (int d = 0; d < D; ++d) product *= std::sin(phase(x, d));
    return product;
  }
  static Vec<D> gradient(bool inside, const Vec<D>& x) {
    if (inside) return value(true, x) * k();
    Vec<D> g;
    for (int d = 0; d < D; ++d) {
      g[d] = 2.0 * std::numbers::pi;
      for (int e = 0; e < D; ++e) g[d] *= e == d ? std::cos(phase(x, e)) : std::sin(phase(x, e));
    }
    return g;
  }
  /// -Lap p
  static double source(bool inside, const Vec<D>& x) {
    return (inside ? -dot(k(), k()) : 4.0 * D * std::numbers::pi * std::numbers::pi) * value(inside, x);
  }
};

struct Circle {
  static constexpr int dimension = 2;
  static constexpr std::ptrdiff_t cells = 64;
  double operator()(const Vec<2>& x) const { return norm(x - Vec<2>{0.51, 0.493}) - 0.3; }
};
struct Ellipse {
  static constexpr int dimension = 2;
  static constexpr std::ptrdiff_t cells = 64;
  double operator()(const Vec<2>& x) const { return std::hypot((x[0] - 0.507) / 0.3, (x[1] - 0.49) / 0.18) - 1.0; }
};
/// Five arms, radii of curvature down to 0.05.
struct Star {
  static constexpr int dimension = 2;
  static constexpr std::ptrdiff_t cells = 128;
  double operator()(const Vec<2>& x) const {
    const Vec<2> y = x - Vec<2>{0.507, 0.49};
    return norm(y) - (0.28 + 0.05 * std::cos(5.0 * std::atan2(y[1], y[0])));
  }
};
struct Sphere {
  static constexpr int dimension = 3;
  static constexpr std::ptrdiff_t cells = 32;
  double operator()(const Vec<3>& x) const { return norm(x - Vec<3>{0.51, 0.493, 0.5}) - 0.3; }
};
struct LongEllipsoid {
  static constexpr int dimension = 3;
  static constexpr std::ptrdiff_t cells = 32;
  double operator()(const Vec<3>& x) const {
    return std::hypot((x[0] - 0.51) / 0.32, (x[1] - 0.493) / 0.24, (x[2] - 0.5) / 0.27) - 1.0;
  }
};
struct Ring {
  static constexpr int dimension = 3;
  static constexpr std::ptrdiff_t cells = 32;
  cambium::Torus torus{{0.51, 0.493, 0.5}, 0.28, 0.12};
  double operator()(const Vec<3>& x) const { return torus(x); }
};

/// Shapes as one type, so that each dimension is compiled once.
template <int D>
using AnyShape = std::function<double(const Vec<D>&)>;

/// Outward normal of a smooth function's level, by differences: off by 1e-9.
template <int D>
Vec<D> normal(const AnyShape<D>& shape, const Vec<D>& x) {
  Vec<D> g;
  for (int d = 0; d < D; ++d) g[d] = shape(x + Vec<D>::unit(d, 1e-5)) - shape(x - Vec<D>::unit(d, 1e-5));
  return g / norm(g);
}

/// Largest errors of a solution, up to its mean.
struct JumpErrors {
  double p = 0.0;
  double gradient = 0.0;      ///< at the nodes
  double at_interface = 0.0;  ///< of either side's value there
  double gradient_at_interface = 0.0;
};

template <int D>
cambium::LevelSet<cambium::ClosestPoint, D> level_set_of(const AnyShape<D>& shape, std::ptrdiff_t cells) {
  return {cambium::Lattice<D>::periodic_box(cambium::Box<D>::cube(), cells), shape};
}

/// Solves for Solution with a jump of type J and the stencil of Symbol, by solve(f, p). \param up_to_constant  true if
/// the solver finds p but for a constant
template <class J, class Solution, class Symbol, class Solve>
JumpErrors solve_jump_with(const AnyShape<J::dimension>& shape, const cambium::Lattice<J::dimension>& lattice,
                           bool up_to_constant, Solve&& solve) {
  constexpr int D = J::dimension;
  const cambium::LevelSet<cambium::ClosestPoint, D> level_set(lattice, shape);
  const auto& band = level_set.band();
  J jump(lattice);
  jump.attach(band, level_set.method().points());
  jump.set([](const Vec<D>& x) { return Solution::value(false, x) - Solution::value(true, x); },
           [&](const Vec<D>& x) {
             return dot(Solution::gradient(false, x) - Solution::gradient(true, x), normal<D>(shape, x));
           },
           [](const Vec<D>& x) { return Solution::source(false, x) - Solution::source(true, x); });
  cambium::Field<double, D> f(lattice), p(lattice);
  cambium::Field<Vec<D>, D> g(lattice);
  for (std::size_t i = 0; i < f.size(); ++i) {
    f[i] = Solution::source(band(lattice.node(i)) < 0.0, lattice.position(lattice.node(i)));
  }
  jump.template correct<Symbol>(f);
  solve(f, p);
  double mean = 0.0;
  for (std::size_t i = 0; i < p.size() && up_to_constant; ++i) {
    mean += Solution::value(band(lattice.node(i)) < 0.0, lattice.position(lattice.node(i))) - p[i];
  }
  for (double& value : p.values()) value += mean / static_cast<double>(p.size());
  jump.template gradient<Symbol>(p, g);
  JumpErrors errors;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const bool inside = band(lattice.node(i)) < 0.0;
    const Vec<D> x = lattice.position(lattice.node(i));
    errors.p = std::max(errors.p, std::abs(p[i] - Solution::value(inside, x)));
    errors.gradient = std::max(errors.gradient, norm(g[i] - Solution::gradient(inside, x)));
  }
  cambium::InterfaceSides<D> sides(lattice);
  jump.at_interface(p, sides);
  const auto& points = level_set.method().points();
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      if (!points.found(b, i) || norm(points.offset(b, i)) > 2.5) continue;
      const Vec<D> x =
          lattice.domain().wrap(lattice.position(band.values().node(b, i)) + points.offset(b, i) * lattice.spacing());
      for (const bool inside : {true, false}) {
        const auto& value = inside ? sides.inside : sides.outside;
        const auto& gradient = inside ? sides.gradient_inside : sides.gradient_outside;
        errors.at_interface = std::max(errors.at_interface, std::abs(value.block(b)[i] - Solution::value(inside, x)));
        errors.gradient_at_interface =
            std::max(errors.gradient_at_interface, norm(gradient.block(b)[i] - Solution::gradient(inside, x)));
      }
    }
  }
  return errors;
}

/// The same in a periodic box.
template <class J, class Solution, class Symbol = cambium::SecondOrder>
JumpErrors solve_jump(const AnyShape<J::dimension>& shape, std::ptrdiff_t cells) {
  constexpr int D = J::dimension;
  const auto lattice = cambium::Lattice<D>::periodic_box(cambium::Box<D>::cube(), cells);
  return solve_jump_with<J, Solution, Symbol>(shape, lattice, true, [&](const auto& f, auto& p) {
    cambium::PeriodicPoisson<D, Symbol>(lattice, {.mean = cambium::MeanPart::subtract}).solve(f, p);
  });
}

}  // namespace scenes
