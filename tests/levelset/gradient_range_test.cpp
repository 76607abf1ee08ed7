// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE gradient_range
#include <boost/test/unit_test.hpp>
#include <tuple>

#include <cambium/levelset/geometry/centred_differences.hpp>
#include <cambium/levelset/geometry/gradient_range.hpp>

#include "support/exact_band.hpp"

using namespace cambium;

namespace {

using Scalars = std::tuple<float, double>;

template <class T, int D>
NarrowBand<T, D> scaled_ball(double smallest, double largest) {
  const Vec<D> centre = Vec<D>::constant(0.5);
  return support::exact_band<T>(Lattice<D>::bounded_box(Box<D>::cube(), 40), 20.0 / 40.0, [=](const Vec<D>& x) {
    const Vec<D> r = x - centre;
    // Both extremes of the factor lie on the interface, where |grad phi| is the factor.
    const double wave = 0.5 + 0.5 * std::sin(0.5 * std::numbers::pi * r[0] / 0.3);
    return (norm(r) - 0.3) * (smallest + (largest - smallest) * wave);
  });
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(finds_the_scale, T, Scalars) {
  const GradientRange exact = gradient_range(scaled_ball<T, 2>(1.0, 1.0));
  // Third-order differences of a distance with h / R = 1/12: 1e-3.
  BOOST_TEST(exact.smallest == 1.0, boost::test_tools::tolerance(1e-3));
  BOOST_TEST(exact.largest == 1.0, boost::test_tools::tolerance(1e-3));
  // A circle of 2 pi 0.3 * 40 spacings and 3 spacings of width.
  BOOST_TEST(static_cast<double>(exact.nodes) == 2.0 * std::numbers::pi * 12.0 * 3.0,
             boost::test_tools::tolerance(0.05));
  // Off the interface the gradient has a component along it, d(factor)/ds phi: the factor is right to some per cent.
  const GradientRange scaled = gradient_range(scaled_ball<T, 3>(0.4, 4.0));
  BOOST_TEST(scaled.smallest == 0.4, boost::test_tools::tolerance(0.05));
  BOOST_TEST(scaled.largest == 4.0, boost::test_tools::tolerance(0.05));
  BOOST_TEST(scaled.anisotropy() == scaled.largest / scaled.smallest);
}

BOOST_AUTO_TEST_CASE(tells_when_to_reinitialise) {
  BOOST_TEST(!reinitialisation_is_due(gradient_range(scaled_ball<double, 2>(1.0, 1.0))));
  BOOST_TEST(!reinitialisation_is_due(gradient_range(scaled_ball<double, 2>(0.8, 1.3))));
  BOOST_TEST(reinitialisation_is_due(gradient_range(scaled_ball<double, 2>(0.5, 1.0))));
  BOOST_TEST(reinitialisation_is_due(gradient_range(scaled_ball<double, 2>(1.0, 2.0))));
  BOOST_TEST(!reinitialisation_is_due(gradient_range(scaled_ball<double, 2>(0.5, 2.0)), {0.4, 2.5}));
}

BOOST_AUTO_TEST_CASE(fronts_that_approach_are_no_flat_phi) {
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 40);
  const double h = lattice.spacing();
  const auto band = support::exact_band<double>(lattice, 6.0 * h, [&](const Vec<2>& x) {
    return std::min(norm(x - Vec<2>{0.3, 0.5}), norm(x - Vec<2>{0.7, 0.5})) - (0.2 - 1.25 * h);
  });
  BOOST_TEST(!reinitialisation_is_due(gradient_range(band)));
  BOOST_TEST(reinitialisation_is_due(gradient_range<CentredDifferences<2>>(band)));
}

BOOST_AUTO_TEST_CASE(threads_do_not_change_a_bit) {
  const auto band = scaled_ball<double, 3>(0.5, 2.0);
  const GradientRange serial = gradient_range(band, Serial{});
  for (const int threads : {1, 2, 3}) {
    const GradientRange other = gradient_range(band, OpenMP{threads});
    BOOST_TEST(other.smallest == serial.smallest);
    BOOST_TEST(other.largest == serial.largest);
    BOOST_TEST(other.nodes == serial.nodes);
  }
}

BOOST_AUTO_TEST_CASE(no_interface_is_an_error) {
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 20);
  const auto band = support::exact_band<double>(lattice, 1.0, [](const Vec<2>&) { return 0.3; });
  BOOST_CHECK_THROW(gradient_range(band), InterfaceError);
}
