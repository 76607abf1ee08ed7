// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <support/manufactured.hpp>
#include <support/order.hpp>

#include <cambium/interface/dirichlet.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/levelset/shapes/torus.hpp>

namespace scenes {

using namespace cambium;

using support::Manufactured;

/// Concentration of a nutrient that a ball of radius R consumes: lap c = c, c = 1 on it.
template <int D>
struct Nutrient {
  Vec<D> centre;
  double radius = 2.0;
  double shift = 1.0;

  static double wave(double r) { return D == 2 ? std::cyl_bessel_i(0.0, r) : r > 0.0 ? std::sinh(r) / r : 1.0; }
  static double slope(double r) { return D == 2 ? std::cyl_bessel_i(1.0, r) : (std::cosh(r) - std::sinh(r) / r) / r; }
  double value(const Vec<D>& x) const { return wave(norm(x - centre)) / wave(radius); }
  Vec<D> gradient(const Vec<D>& x) const {
    const double r = norm(x - centre);
    return (x - centre) * (slope(r) / (r * wave(radius)));
  }
  double right_side(const Vec<D>&) const { return 0.0; }
};

struct Errors {
  double value = 0.0;       ///< of c at the nodes of the domain
  double derivative = 0.0;  ///< of dc/dn at the interface
  double beyond = 0.0;      ///< of c where it was continued
  int iterations = 0;
};

/// Data at the walls: those of a problem that reaches them.
template <class P, class T, int D>
void set_walls(const P& problem, Field<T, D>& c) {
  const auto& lattice = c.lattice();
  for (std::size_t i = 0; i < c.size(); ++i) {
    const Index<D> node = lattice.node(i);
    for (int d = 0; d < D; ++d) {
      if (node[d] == 0 || node[d] == lattice.nodes()[d] - 1) {
        c[i] = static_cast<T>(problem.value(lattice.position(node)));
      }
    }
  }
}

/// Largest errors of a problem on one side of a shape, whose normal is found by differences.
template <int D, class T = double, class F, class P>
Errors errors(const Lattice<D>& lattice, F&& shape, const P& problem, Side side = Side::inside) {
  const LevelSet<ClosestPoint, D> level_set(lattice, shape);
  const auto& band = level_set.band();
  const auto& points = level_set.method().points();
  typename Dirichlet<D, T>::Params params;
  params.side = side;
  params.shift = problem.shift;
  Dirichlet<D, T> dirichlet(band, params);
  const auto f = sample(lattice, [&](const Vec<D>& x) { return static_cast<T>(problem.right_side(x)); });
  Field<T, D> c(lattice);
  set_walls(problem, c);
  Errors result;
  result.iterations = dirichlet
                          .solve(
                              f, [&](const Vec<D>& x) { return problem.value(x); }, c)
                          .iterations;
  const auto error = [&](std::size_t i) {
    return std::abs(static_cast<double>(c[i]) - problem.value(lattice.position(lattice.node(i))));
  };
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (dirichlet.in_domain(lattice.node(i))) result.value = std::max(result.value, error(i));
  }
  Field<double, D, Sparse> derivative(lattice);
  dirichlet.normal_derivative(band, points, c, derivative);
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      if (!points.found(b, i)) continue;
      const Vec<D> x = lattice.position(band.values().node(b, i)) + points.offset(b, i) * lattice.spacing();
      Vec<D> n;
      for (int d = 0; d < D; ++d) {
        const Vec<D> step = Vec<D>::unit(d, 1e-5);
        n[d] = shape(x + step) - shape(x - step);
      }
      const double exact = dot(problem.gradient(x), n) / norm(n);
      result.derivative = std::max(result.derivative, std::abs(derivative.block(b)[i] - exact));
    }
  }
  const auto before = c;
  dirichlet.continue_beyond(c, 3);
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (c[i] != before[i]) result.beyond = std::max(result.beyond, error(i));
  }
  return result;
}

/// Scaled so that it is no distance; the zero set is the ellipsoid.
template <int D>
struct Oval {
  static constexpr int dimension = D;
  static constexpr std::ptrdiff_t cells = D == 2 ? 64 : 28;
  double operator()(const Vec<D>& x) const {
    const double half[3] = {0.37, 0.25, 0.3};
    double sum = 0.0;
    for (int d = 0; d < D; ++d) sum += std::pow((x[d] - 0.5 - 0.003 * d) / half[d], 2);
    return 0.3 * (std::sqrt(sum) - 1.0);
  }
};
struct Star {
  static constexpr int dimension = 2;
  static constexpr std::ptrdiff_t cells = 80;
  double operator()(const Vec<2>& x) const {
    const double a = x[0] - 0.503, b = x[1] - 0.497;
    return std::hypot(a, b) - (0.28 + 0.05 * std::cos(5.0 * std::atan2(b, a)));
  }
};
struct Ring {
  static constexpr int dimension = 3;
  static constexpr std::ptrdiff_t cells = 28;
  double operator()(const Vec<3>& x) const { return Torus({0.51, 0.492, 0.503}, 0.24, 0.13)(x); }
};

template <class F, Side S>
struct Case {
  using Shape = F;
  static constexpr Side side = S;
};

inline void report(const Errors& coarse, const Errors& fine) {
  BOOST_TEST_MESSAGE("c " << coarse.value << ' ' << fine.value << "  dc/dn " << coarse.derivative << ' '
                          << fine.derivative << "  beyond " << coarse.beyond << ' ' << fine.beyond << "  iterations "
                          << fine.iterations);
}

/// Second order of the manufactured solution, on a lattice and one of half the spacing.
template <class C>
void check_orders(double of_value, double of_derivative) {
  constexpr int D = C::Shape::dimension;
  const typename C::Shape shape;
  const Manufactured<D> problem{1.5};
  const auto at = [&](std::ptrdiff_t cells) {
    return errors(Lattice<D>::bounded_box(Box<D>::cube(), cells), shape, problem, C::side);
  };
  const Errors coarse = at(C::Shape::cells);
  const Errors fine = at(2 * C::Shape::cells);
  report(coarse, fine);
  BOOST_CHECK_GT(support::observed_order(coarse.value, fine.value), of_value);
  BOOST_CHECK_GT(support::observed_order(coarse.derivative, fine.derivative), of_derivative);
  BOOST_CHECK_GT(support::observed_order(coarse.beyond, fine.beyond), of_value);
  BOOST_CHECK_LE(fine.iterations, 8);  // measured 4 or 5
}

/// Second order of the nutrient of a ball of radius 2. \return errors on the finer lattice
template <int D>
Errors check_nutrient(std::ptrdiff_t cells) {
  const Nutrient<D> problem{Vec<D>::constant(0.02)};
  const Ball<D> ball(problem.centre, problem.radius);
  const auto at = [&](std::ptrdiff_t n) {
    return errors(Lattice<D>::bounded_box({Vec<D>::constant(-3.0), Vec<D>::constant(3.0)}, n), ball, problem);
  };
  const Errors coarse = at(cells);
  const Errors fine = at(2 * cells);
  report(coarse, fine);
  BOOST_CHECK_GT(support::observed_order(coarse.value, fine.value), 1.8);
  BOOST_CHECK_GT(support::observed_order(coarse.derivative, fine.derivative), 1.8);
  return fine;
}

}  // namespace scenes
