// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE tumour
#include <boost/test/unit_test.hpp>

#include "support/order.hpp"
#include "tumour_scenes.hpp"

using namespace cambium;
using namespace scenes;

// R(t) from R(0) = 2 by quadrature in 40 digits: A = 0.5, G = 20, G_N = 1.
using Disc = Tumour<2, SemiImplicit>;

BOOST_AUTO_TEST_CASE(discs_grow_as_the_exact_equation_says) {
  const double coarse = radius_error<Disc>(24, 0.1, 2.35800262640, 1.0);
  const double fine = radius_error<Disc>(48, 0.1, 2.35800262640, 1.0);
  BOOST_TEST(std::abs(fine) < 1e-3);
  BOOST_TEST(std::abs(fine) < 0.4 * std::abs(coarse));
}

BOOST_AUTO_TEST_CASE(steps_are_of_second_order_in_time) {
  const auto at = [](int steps) {
    Disc disc(lattice<2>(32), ball<2>(2.0), {.parameters = {.tension = 0.005}, .courant = 10.0, .change = 10.0});
    for (int i = 0; i < steps; ++i) disc.step(0.1 / steps);
    return radius_of(disc);
  };
  const double few = at(4), more = at(8), many = at(16);
  const double order = support::observed_order(few - more, more - many);
  BOOST_TEST_MESSAGE("R(0.1) " << few << ' ' << more << ' ' << many << ", order " << order);
  BOOST_TEST(order > 1.6);
}

BOOST_AUTO_TEST_CASE(a_tumour_that_reaches_the_box_stops_as_it_was_before_the_step) {
  Disc tumour(lattice<2>(48), ball<2>(3.3), {.parameters = {.apoptosis = 0.1, .tension = 0.005}});
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
  Disc tumour(lattice<2>(48), ball<2>(1.0), {.parameters = {.apoptosis = 1.5, .tension = 0.0}});
  TumourStep step;
  for (int i = 0; i < 80 && !tumour.extinct(); ++i) step = tumour.step(0.05);
  BOOST_TEST(step.extinct);
  BOOST_TEST(tumour.extinct());
  BOOST_CHECK_THROW(tumour.step(0.01), ValueError);
}

BOOST_AUTO_TEST_CASE(steps_say_what_they_are_bound_by) {
  const Disc disc(lattice<2>(48), ball<2>(2.0));
  const TumourStep step = disc.next_step();
  const double h = disc.lattice().spacing();
  BOOST_TEST(step.advection_limit == 0.25 * h / step.largest_speed, boost::test_tools::tolerance(1e-12));
  BOOST_CHECK(std::isinf(step.tension_limit));
  BOOST_CHECK(step.bound == Limit::growth);  // the first is a short one
  BOOST_TEST(step.dt < 0.25 * step.advection_limit);
  BOOST_TEST(disc.next_step(1.5 * step.dt).dt == 0.75 * step.dt, boost::test_tools::tolerance(1e-12));
  BOOST_CHECK(disc.next_step(1e-9).bound == Limit::given);
  const TumourStep stiff = Tumour<2>(lattice<2>(48), ball<2>(2.0)).next_step();
  BOOST_TEST(stiff.tension_limit == 0.8 * 0.5 * 2.0 * std::pow(h / std::numbers::pi, 3),
             boost::test_tools::tolerance(1e-12));
  BOOST_CHECK(stiff.bound == Limit::tension);
  BOOST_CHECK_THROW(Disc(lattice<2>(48), ball<2>(3.75)), TumourAtWallError);
  BOOST_CHECK_THROW(Disc(lattice<2>(48), ball<2>(2.0), {.parameters = {.tension = -1.0}}), ValueError);
}

BOOST_AUTO_TEST_CASE(threads_change_no_bit) {
  const auto run = [](int threads) {
    Disc tumour(lattice<2>(48), ball<2>(2.0), {}, OpenMP{threads});
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
  BOOST_TEST(detail::cube_below<0>(Vec<2>{1.0, 1.0}, 0.0) == 0.5, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(detail::cube_below<0>(Vec<2>{1.0, 1.0}, -0.5) == 0.125, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(detail::cube_below<0>(Vec<3>{0.0, -2.0, 0.0}, 0.5) == 0.75, boost::test_tools::tolerance(1e-2));
  BOOST_TEST(detail::cube_below<0>(Vec<3>{1.0, 1.0, 1.0}, -1.0) == 1.0 / 48.0, boost::test_tools::tolerance(1e-12));
}
