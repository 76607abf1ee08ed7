// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE right_hand_side_gmres
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <support/count_allocations.hpp>
#include <tuple>

#include <cambium/interface.hpp>
#include <cambium/interface/dirichlet.hpp>
#include <cambium/interface/right_hand_side_gmres.hpp>
#include <cambium/levelset.hpp>
#include <cambium/poisson.hpp>

#include "support/fed_ball.hpp"
#include "support/order.hpp"

using namespace cambium;

namespace {

template <int D>
std::array<Boundary, D> values() {
  std::array<Boundary, D> result;
  result.fill(Boundary::dirichlet);
  return result;
}

/// Largest errors inside a fed ball with p = 0 outside.
struct Errors {
  double p = 0.0;
  double speed = 0.0;    ///< of V = -dp/dn at the interface, relative
  double outside = 0.0;  ///< |p| there
  int iterations = 0;
};

/// The right-hand side and what is read from a solution.
template <int D>
struct Scene {
  using Case = support::FedBall<D>;
  Lattice<D> lattice;
  LevelSet<ClosestPoint, D> level_set;
  Field<double, D> f, p;

  explicit Scene(std::ptrdiff_t cells)
      : lattice(Case::lattice(cells)),
        level_set(lattice, Ball<D>(Case::centre(), Case::radius)),
        f(lattice),
        p(lattice) {
    for (std::size_t i = 0; i < f.size(); ++i) {
      if (inside(i)) f[i] = Case::source(lattice.position(lattice.node(i)));
    }
  }
  bool inside(std::size_t i) const { return level_set.band()(lattice.node(i)) < 0.0; }
  template <class V>
  Errors errors(V&& velocity) const {
    Errors result;
    for (std::size_t i = 0; i < p.size(); ++i) {
      double& to = inside(i) ? result.p : result.outside;
      to = std::max(to, std::abs(p[i] - (inside(i) ? Case::pressure(lattice.position(lattice.node(i))) : 0.0)));
    }
    const auto& band = level_set.band();
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      for (std::size_t i = 0; i < band.volume; ++i) {
        if (std::abs(band.values().block(b)[i]) > lattice.spacing()) continue;
        const Vec<D> x = lattice.position(band.values().node(b, i)) - Case::centre();
        result.speed = std::max(result.speed, std::abs(velocity(b, i, x / norm(x)) / Case::speed() - 1.0));
      }
    }
    return result;
  }
};

/// \tparam J   which jump is corrected; \param slope  [dp/dn]
template <class J, class Solver>
Errors by_right_hand_side(Scene<J::dimension>& scene, Solver&& poisson, double slope) {
  constexpr int D = J::dimension;
  using Case = support::FedBall<D>;
  J jump(scene.lattice);
  jump.attach(scene.level_set.band(), scene.level_set.method().points());
  jump.set([](const Vec<D>&) { return -Case::surface_pressure; }, [=](const Vec<D>&) { return slope; },
           [](const Vec<D>& x) { return -Case::source(x); });
  jump.correct(scene.f);
  RightHandSideGmres<D> outside(scene.lattice);
  outside.attach(scene.level_set.band());
  const SolveReport report = outside.solve(poisson, scene.f, scene.p);
  InterfaceSides<D> sides(scene.lattice);
  jump.at_interface(scene.p, sides);
  Errors result = scene.errors(
      [&](std::size_t b, std::size_t i, const Vec<D>& n) { return -dot(sides.gradient_inside.block(b)[i], n); });
  result.iterations = report.iterations;
  return result;
}
template <int D>
Errors by_dirichlet(Scene<D>& scene) {
  const auto& band = scene.level_set.band();
  Dirichlet<D> inside(band);
  Field<double, D, Sparse> slope(scene.lattice);
  const SolveReport report = inside.solve(
      scene.f, [](const Vec<D>&) { return support::FedBall<D>::surface_pressure; }, scene.p);
  inside.normal_derivative(band, scene.level_set.method().points(), scene.p, slope);
  Errors result = scene.errors([&](std::size_t b, std::size_t i, const Vec<D>&) { return -slope.block(b)[i]; });
  result.iterations = report.iterations;
  return result;
}
void report(const char* name, const Errors& coarse, const Errors& fine) {
  BOOST_TEST_MESSAGE(name << ": p " << coarse.p << ' ' << fine.p << " order "
                          << support::observed_order(coarse.p, fine.p) << ", V " << coarse.speed << ' ' << fine.speed
                          << " order " << support::observed_order(coarse.speed, fine.speed) << ", outside "
                          << fine.outside << ", iterations " << coarse.iterations << ' ' << fine.iterations);
}

template <int N>
using Dimension = std::integral_constant<int, N>;
using Dimensions = std::tuple<Dimension<2>, Dimension<3>>;

}  // namespace

// Theory: the value on the interface is off by |dp/dn| times up to a spacing. Measured: p 0.98 (2D) and 1.05 (3D) with
// an error of 0.14 and 0.22, 96 and 59 times that of Dirichlet on the same lattice; V off by 37% and 40% on any
// lattice, as jump corrections that know of no [dp/dn] give both sides the mean of their slopes.
BOOST_AUTO_TEST_CASE_TEMPLATE(dirichlet_is_better, I, Dimensions) {
  constexpr int D = I::value;
  Errors gmres[2], dirichlet[2];
  for (int k = 0; k < 2; ++k) {
    Scene<D> changed((D == 2 ? 64 : 32) << k), solved((D == 2 ? 64 : 32) << k);
    gmres[k] = by_right_hand_side<JumpMayo<D>>(changed, FreeSpacePoisson<D>(changed.lattice), 0.0);
    dirichlet[k] = by_dirichlet(solved);
  }
  report("right-hand side", gmres[0], gmres[1]);
  report("Dirichlet", dirichlet[0], dirichlet[1]);
  BOOST_TEST(gmres[1].outside < 1e-5);  // the tolerance of 1e-7 times p there without the sources, up to 14
  BOOST_TEST(support::observed_order(gmres[0].p, gmres[1].p) > 0.8);
  BOOST_TEST(support::observed_order(gmres[0].p, gmres[1].p) < 1.3);
  BOOST_TEST(support::observed_order(gmres[0].speed, gmres[1].speed) < 0.4);
  BOOST_TEST(gmres[1].speed > 0.2);
  BOOST_TEST(gmres[1].iterations > gmres[0].iterations);
  BOOST_TEST(dirichlet[1].p < 0.03 * gmres[1].p);
  BOOST_TEST(dirichlet[1].speed < 0.03 * gmres[1].speed);
  BOOST_TEST(dirichlet[1].speed <
             0.005);  // 0.09% in the plane with 128 cells along a side of 6, 0.26% in space with 64
  BOOST_TEST(support::observed_order(dirichlet[0].p, dirichlet[1].p) > 1.85);
  // 1.63 and 1.71: the largest error scatters with the lattice; growth_rates_test has the orders.
  BOOST_TEST(support::observed_order(dirichlet[0].speed, dirichlet[1].speed) > 1.5);
}

// With the [dp/dn] that is the answer, the same loop has second order: what is wrong is the correction for the jump.
BOOST_AUTO_TEST_CASE(second_order_if_the_velocity_were_known) {
  Errors known[2];
  for (int k = 0; k < 2; ++k) {
    Scene<2> scene(64 << k);
    known[k] =
        by_right_hand_side<Jump<2>>(scene, BoxPoisson<2>(scene.lattice, values<2>()), support::FedBall<2>::speed());
  }
  report("right-hand side, [dp/dn] known", known[0], known[1]);
  BOOST_TEST(support::observed_order(known[0].p, known[1].p) > 1.9);  // 2.01, and 2.03
  BOOST_TEST(support::observed_order(known[0].speed, known[1].speed) > 1.9);
}

// Sources outside have the solution that is zero at their nodes: free space and a box of zero values leave the same
// inside. No number of threads changes a bit. Sources are the first guess of the next solve.
BOOST_AUTO_TEST_CASE(the_same_with_any_solver_and_any_threads) {
  Scene<2> scene(48);
  RightHandSideGmres<2> outside(scene.lattice, {.tolerance = 1e-11});
  outside.attach(scene.level_set.band());
  Field<double, 2> q(scene.lattice);
  BoxPoisson<2> box(scene.lattice, values<2>());
  FreeSpacePoisson<2> infinite(scene.lattice);
  outside.solve(box, scene.f, scene.p);
  BOOST_TEST(outside.solve(box, scene.f, q).iterations == 0);
  outside.attach(scene.level_set.band());
  outside.solve(infinite, scene.f, q);
  double difference = 0.0;
  for (std::size_t i = 0; i < q.size(); ++i) difference = std::max(difference, std::abs(q[i] - scene.p[i]));
  BOOST_TEST(difference < 1e-8);
  for (const int threads : {1, 2, 3}) {
    outside.attach(scene.level_set.band());
    BoxPoisson<2> solver(scene.lattice, values<2>(), {}, OpenMP{threads});
    Field<double, 2> again(scene.lattice);
    outside.solve(solver, scene.f, again);
    BOOST_TEST(std::ranges::equal(again.values(), scene.p.values()));
  }
}

// But for the report, and what Eigen's loop takes by malloc.
BOOST_AUTO_TEST_CASE(solutions_take_no_fields) {
  Scene<2> scene(48);
  RightHandSideGmres<2> outside(scene.lattice);
  BoxPoisson<2> box(scene.lattice, values<2>());
  for (const int k : {0, 1}) {
    outside.attach(scene.level_set.band());
    const std::size_t before = support::allocated_bytes;
    outside.solve(box, scene.f, scene.p);
    // The residuals, and less than the values of the nodes beside the interface.
    if (k > 0) BOOST_TEST(support::allocated_bytes - before < 4000U + outside.nodes().size() * sizeof(double));
  }
}

BOOST_AUTO_TEST_CASE(what_cannot_be_solved_is_told) {
  Scene<2> scene(32);
  BoxPoisson<2> box(scene.lattice, values<2>());
  RightHandSideGmres<2> outside(scene.lattice, {.most_iterations = 3});
  const auto unchanged = [&] { return std::ranges::all_of(scene.p.values(), [](double p) { return p == 0.0; }); };
  BOOST_CHECK_THROW(outside.solve(box, scene.f, scene.p), ValueError);  // no interface yet
  outside.attach(scene.level_set.band());
  BOOST_CHECK_EXCEPTION(outside.solve(box, scene.f, scene.p), ConvergenceError,
                        [](const ConvergenceError& e) { return e.residuals().size() >= 2; });
  BOOST_TEST(unchanged());
  scene.f[700] = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_THROW(outside.solve(box, scene.f, scene.p), ValueError);
  BOOST_TEST(unchanged());
  Field<double, 2> other(Lattice<2>::bounded_box(Box<2>::cube(), 32));
  BOOST_CHECK_THROW(outside.solve(box, other, scene.p), SizeError);
  BOOST_CHECK_THROW(RightHandSideGmres<2>(other.lattice()).attach(scene.level_set.band()), SizeError);
}
