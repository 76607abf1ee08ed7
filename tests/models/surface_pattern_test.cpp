// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE surface_pattern
#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <support/count_allocations.hpp>
#include <support/order.hpp>
#include <tuple>
#include <vector>

#include <cambium/levelset/measures.hpp>
#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/models.hpp>
#include <cambium/reaction.hpp>
#include <cambium/time.hpp>

using namespace cambium;

namespace {

using Precisions = std::tuple<double, float>;

/// No reaction.
struct Inert {
  static constexpr int species = 1;
  Vec<1> operator()(const Vec<1>&) const { return {0.0}; }
};

template <int D>
LevelSet<ClosestPoint, D> ball(double radius, double half_edge, std::ptrdiff_t cells) {
  const auto lattice = Lattice<D>::bounded_box({Vec<D>::constant(-half_edge), Vec<D>::constant(half_edge)}, cells);
  return {lattice, Ball<D>(Vec<D>::constant(0.0123), radius)};
}

template <int D>
double radius_of(const LevelSet<ClosestPoint, D>& surface) {
  const double volume = measures(surface.band()).volume;
  return D == 2 ? std::sqrt(volume / 3.141592653589793) : std::cbrt(0.75 * volume / 3.141592653589793);
}

/// u = c n, written as a user would.
struct Growth {
  Vec<2> operator()(const Vec<1>& c, const Vec<2>&, const Vec<2>& n) const { return c[0] * n; }
};

/// Error of the radius of a circle that grows by what is on it: c R stays, so R^2 = 1 + 2 t.
template <class Motion>
double growth_error(std::ptrdiff_t cells, int steps, const Motion& motion) {
  SurfacePattern<Inert, Motion, StabilisedSteps, SurfaceLaplacian<2>, 2> pattern(ball<2>(1.0, 2.2, cells), Inert{},
                                                                                 Vec<1>{0.1}, motion);
  pattern.sample([](const Vec<2>&) { return Vec<1>{1.0}; });
  const double amount = pattern.amount(0);
  for (int n = 0; n < steps; ++n) pattern.advance(0.5 / steps);
  BOOST_TEST(std::abs(pattern.amount(0) / amount - 1.0) < 1e-3);
  return std::abs(radius_of<2>(pattern.surface()) - std::sqrt(2.0));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_circle_grows_by_what_is_on_it_to_second_order) {
  const MotionBySpecies<Growth, 2> own(Growth{});
  const double coarse = growth_error(48, 3, own), fine = growth_error(96, 6, own);
  BOOST_TEST_MESSAGE("errors " << coarse << ", " << fine);
  BOOST_TEST(support::observed_order(coarse, fine) > 1.8);
  BOOST_TEST(growth_error(48, 3, GrowthBySpecies<2>()) == coarse);
}

// V = -kappa: R^2 = 1 - 2 t in 2D, and what is on the circle stays: c = 1 / R.
BOOST_AUTO_TEST_CASE(a_circle_shrinks_by_its_curvature) {
  double error[2];
  for (const int k : {0, 1}) {
    const std::ptrdiff_t cells = k == 0 ? 32 : 64;
    SurfacePattern<Inert, CurvatureMotion<2>, StabilisedSteps, SurfaceLaplacian<2>, 2> pattern(
        ball<2>(1.0, 2.0, cells), Inert{}, Vec<1>{0.1}, CurvatureMotion<2>());
    pattern.sample([](const Vec<2>&) { return Vec<1>{1.0}; });
    const int steps = k == 0 ? 50 : 200;  // 0.16 h^2
    for (int n = 0; n < steps; ++n) pattern.advance(0.125 / steps);
    error[k] = std::abs(radius_of<2>(pattern.surface()) - std::sqrt(0.75));
    BOOST_TEST(std::abs(pattern.concentration(0)[0] * std::sqrt(0.75) - 1.0) < 2e-3);
  }
  BOOST_TEST_MESSAGE("errors " << error[0] << ", " << error[1]);
  BOOST_TEST(support::observed_order(error[0], error[1]) > 1.8);
}

// Degree 4 of the circle's modes, in the growing direction: the rate of the dispersion relation with k2 = 16.
BOOST_AUTO_TEST_CASE(a_mode_grows_at_the_rate_of_the_dispersion_relation) {
  constexpr Vec<2> diffusivity{0.516 * 0.088 * 0.28, 0.088 * 0.28};
  SurfacePattern<LinearisedBrusselator, FixedSurface, StabilisedSteps, SurfaceLaplacian<2>, 2> pattern(
      ball<2>(1.0, 1.6, 64), varea_spots, diffusivity, FixedSurface{},
      {.steps = {.absolute = 1e-10, .relative = 1e-4}});
  const double rate = growth_rate(varea_spots, {}, diffusivity, 16.0);
  BOOST_TEST(rate > 0.0);
  const Vec<2> v = growing_direction(varea_spots.jacobian({}), diffusivity, 16.0, rate);
  pattern.sample(
      [&](const Vec<2>& x) { return v * (1e-6 * std::cos(4.0 * std::atan2(x[1] - 0.0123, x[0] - 0.0123))); });
  const auto size = [&] {
    double sum = 0.0;
    for (const double c : pattern.concentration(0)) sum += c * c;
    return std::sqrt(sum);
  };
  const double before = size();
  const AdaptiveReport report = pattern.advance(50.0);
  const double measured = std::log(size() / before) / 50.0;
  BOOST_TEST_MESSAGE("rate " << measured << " against " << rate << " in " << report.evaluations << " evaluations");
  BOOST_TEST(std::abs(measured / rate - 1.0) < 0.01);
}

BOOST_AUTO_TEST_CASE(threads_do_not_change_a_bit_and_bad_input_is_refused) {
  const auto run = [](int threads) {
    const auto flow = PrescribedMotion{[](const Vec<2>& x, double) { return 0.3 * x; }};
    SurfacePattern<Schnakenberg, std::remove_const_t<decltype(flow)>, StabilisedSteps, SurfaceLaplacian<2>, 2, double,
                   OpenMP>
        pattern(ball<2>(1.0, 1.8, 40), schnakenberg_spots, schnakenberg_diffusivities, flow, {}, OpenMP{threads});
    const SmoothNoise<2> noise(7, 5.0);
    pattern.sample([&](const Vec<2>& x) { return Vec<2>{1.0, 0.9} + Vec<2>{0.01, 0.0} * noise(x); });
    pattern.advance(0.02);
    return std::vector<double>(pattern.concentration(0).begin(), pattern.concentration(0).end());
  };
  const auto one = run(1);
  BOOST_TEST((run(2) == one));
  BOOST_TEST((run(3) == one));
  BOOST_CHECK_THROW((SurfacePattern<Inert, FixedSurface, StabilisedSteps, SurfaceLaplacian<2>, 2>(
                        ball<2>(1.0, 1.8, 40), Inert{}, Vec<1>{-1.0})),
                    ValueError);
}

// cos(2 theta) on the unit circle decays at 4 D; in a second interval nothing is allocated.
BOOST_AUTO_TEST_CASE_TEMPLATE(chemistry_of_either_precision_allocates_no_arrays, T, Precisions) {
  const auto lattice = Lattice<2>::bounded_box({{-1.6, -1.6}, {1.6, 1.6}}, 48);
  const LevelSet<ClosestPoint, 2, T> circle(lattice, Ball<2>({0.0123, 0.0123}, 1.0));
  SurfacePattern<Inert, FixedSurface, StabilisedSteps, SurfaceLaplacian<2>, 2, T, Serial> pattern(
      circle, Inert{}, Vec<1>{0.5}, FixedSurface{}, {.steps = {.absolute = 1e-4, .relative = 0.0}});
  const auto mode = [](const Vec<2>& x) { return std::cos(2.0 * std::atan2(x[1] - 0.0123, x[0] - 0.0123)); };
  pattern.sample([&](const Vec<2>& x) { return Vec<1>{mode(x)}; });
  pattern.advance(0.25);
  const std::size_t before = support::allocations;
  const AdaptiveReport report = pattern.advance(0.25);
  const std::size_t allocated = support::allocations - before;
  BOOST_TEST(allocated == 0U);
  BOOST_TEST(report.steps > 1U);
  double worst = 0.0;
  for (std::size_t k = 0; k < pattern.band().size(); ++k) {
    worst = std::max(worst, std::abs(static_cast<double>(pattern.concentration(0)[k]) -
                                     std::exp(-1.0) * mode(pattern.band().point(k))));
  }
  BOOST_TEST(worst < 3e-3);  // 1.5e-3 measured, of the second-order stencil
}

BOOST_AUTO_TEST_CASE(an_explicit_step_beyond_its_limit_is_refused) {
  using State = Columns<1, double>;
  SurfacePattern<Inert, FixedSurface, StabilisedSteps, SurfaceLaplacian<2>, 2> pattern(ball<2>(1.0, 1.6, 48), Inert{},
                                                                                       Vec<1>{0.5});
  pattern.sample([](const Vec<2>& x) { return Vec<1>{1.0 + x[0]}; });
  const std::vector<double> before(pattern.concentration(0).begin(), pattern.concentration(0).end());
  const double limit = 2.0 / (0.5 * pattern.band().spectral_radius());
  const auto rate = [&](const auto& c, double, const auto& to) { pattern.rate(c, to); };
  FixedSteps<Euler, State> euler;
  BOOST_CHECK_THROW(euler.advance(pattern.state(), 0.0, 1.2 * limit, 100, rate), StabilityError);
  BOOST_TEST(std::ranges::equal(before, pattern.concentration(0)));
  euler.advance(pattern.state(), 0.0, 0.95 * limit, 100, rate);
  for (const double c : pattern.concentration(0)) BOOST_TEST(std::abs(c - 1.0) < 1.0);
}
