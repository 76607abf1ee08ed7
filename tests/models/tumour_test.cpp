// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE tumour
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/models/tumour.hpp>

#include "support/order.hpp"

using namespace cambium;

namespace {

template <int D>
Lattice<D> lattice(std::ptrdiff_t cells) {
  return Lattice<D>::bounded_box({Vec<D>::constant(-4.5), Vec<D>::constant(4.5)}, cells);
}
template <int D>
Ball<D> ball(double radius) {
  return {Vec<D>::constant(0.02) + Vec<D>::unit(0, 0.03), radius};
}
/// Radius of the ball of the tumour's volume.
template <class Tumour>
double radius_of(const Tumour& tumour) {
  constexpr int D = Tumour::dimension;
  const double volume = measures(tumour.level_set().band()).volume;
  return D == 2 ? std::sqrt(volume / std::numbers::pi) : std::cbrt(0.75 * volume / std::numbers::pi);
}
/// Relative error of R(end), R(0) = 2. R(t) is the same for all tensions and both conditions outside; a tension so
/// small leaves explicit steps to the CFL number.
template <class Tumour>
double radius_error(std::ptrdiff_t cells, double end, double exact) {
  constexpr int D = Tumour::dimension;
  Tumour tumour(lattice<D>(cells), ball<D>(2.0), {.parameters = {.tension = 0.005}});
  while (tumour.time() < end) {
    const TumourStep step = tumour.step(end - tumour.time());
    BOOST_REQUIRE(step.dt > 0.0);
    if (end - tumour.time() < 1e-12) break;
  }
  const double error = radius_of(tumour) / exact - 1.0;
  BOOST_TEST_MESSAGE(D << "D, " << cells << " cells: " << error);
  return error;
}

}  // namespace

// R(0.1) by quadrature in 40 digits: A = 0.5, G = 20, G_N = 1.
BOOST_AUTO_TEST_CASE(discs_grow_as_the_exact_equation_says) {
  const double coarse = radius_error<Tumour<2>>(32, 0.1, 2.35800262640);
  const double fine = radius_error<Tumour<2>>(64, 0.1, 2.35800262640);
  BOOST_TEST(std::abs(fine) < 1e-3);
  BOOST_TEST(std::abs(fine) < 0.4 * std::abs(coarse));
}
BOOST_AUTO_TEST_CASE(the_outside_does_not_matter_to_discs) {
  BOOST_TEST(std::abs(radius_error<Tumour<2, ZeroOutside>>(64, 0.1, 2.35800262640)) < 1e-3);
}
BOOST_AUTO_TEST_CASE(a_necrotic_core_slows_growth_down) {
  BOOST_TEST(std::abs(radius_error<Tumour<2, Necrosis>>(64, 0.1, 2.07128418372)) < 1e-3);
}
BOOST_AUTO_TEST_CASE(balls_grow_as_the_exact_equation_says) {
  BOOST_TEST(std::abs(radius_error<Tumour<3>>(40, 0.05, 2.20409982622)) < 1e-3);
}

BOOST_AUTO_TEST_CASE(a_tumour_that_reaches_the_box_stops_as_it_was_before_the_step) {
  Tumour<2> tumour(lattice<2>(48), ball<2>(3.3), {.parameters = {.apoptosis = 0.1, .tension = 0.005}});
  double time = 0.0, radius = 0.0;
  const auto run = [&] {
    for (int i = 0; i < 60; ++i) {
      time = tumour.time();
      radius = radius_of(tumour);
      tumour.step(0.05);
    }
  };
  BOOST_CHECK_THROW(run(), TumourAtWallError);
  BOOST_TEST(tumour.time() == time);
  BOOST_TEST(radius_of(tumour) == radius);
  BOOST_TEST(radius > 3.3);
}

BOOST_AUTO_TEST_CASE(a_tumour_that_dies_out_says_so) {
  Tumour<2> tumour(lattice<2>(48), ball<2>(1.0), {.parameters = {.apoptosis = 1.5, .tension = 0.0}});
  TumourStep step;
  for (int i = 0; i < 80 && !tumour.extinct(); ++i) step = tumour.step(0.05);
  BOOST_TEST(step.extinct);
  BOOST_TEST(tumour.extinct());
  BOOST_CHECK_THROW(tumour.step(0.01), ValueError);
}

BOOST_AUTO_TEST_CASE(steps_say_what_they_are_bound_by) {
  const Tumour<2> stiff(lattice<2>(48), ball<2>(2.0));
  BOOST_CHECK(stiff.next_step().bound == Limit::tension);
  BOOST_CHECK(stiff.next_step(1e-9).bound == Limit::given);
  const Tumour<2, SemiImplicit> implicit(lattice<2>(48), ball<2>(2.0));
  BOOST_TEST(implicit.next_step().tension_limit == 32.0 * stiff.next_step().tension_limit,
             boost::test_tools::tolerance(1e-12));
  BOOST_CHECK_THROW((Tumour<2>(lattice<2>(48), ball<2>(3.75))), TumourAtWallError);
  BOOST_CHECK_THROW((Tumour<2>(lattice<2>(48), ball<2>(2.0), {.parameters = {.tension = -1.0}})), ValueError);
}

BOOST_AUTO_TEST_CASE(threads_change_no_bit) {
  const auto run = [](int threads) {
    Tumour<2, SemiImplicit> tumour(lattice<2>(48), ball<2>(2.0), {}, OpenMP{threads});
    for (int i = 0; i < 2; ++i) tumour.step();
    double sum = 0.0;
    for (std::size_t b = 0; b < tumour.level_set().band().blocks(); ++b) {
      for (const double phi : tumour.level_set().band().values().block(b)) sum += phi * phi;
    }
    return sum;
  };
  const double one = run(1);
  BOOST_TEST(run(2) == one);
  BOOST_TEST(run(3) == one);
}

BOOST_AUTO_TEST_CASE(shares_of_cells_are_those_of_planes) {
  BOOST_TEST(detail::share_below(Vec<2>{1.0, 1.0}, 0.0) == 0.5, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(detail::share_below(Vec<2>{1.0, 1.0}, -0.5) == 0.125, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(detail::share_below(Vec<3>{0.0, -2.0, 0.0}, 0.5) == 0.75, boost::test_tools::tolerance(1e-2));
  BOOST_TEST(detail::share_below(Vec<3>{1.0, 1.0, 1.0}, -1.0) == 1.0 / 48.0, boost::test_tools::tolerance(1e-12));
}
