// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE lagrangian_reinit
#include <boost/test/unit_test.hpp>
#include <cmath>

#include <cambium/levelset/reinit/lagrangian_reinit.hpp>

#include "levelset/scaled_ball.hpp"

using namespace cambium;

namespace {

/// Error within so many spacings of a ball whose phi is `slope` times the distance.
template <int D>
double error(double slope, double within, const LagrangianReinitParams& params) {
  typename LevelSet<LagrangianReinit<>, D>::Params all;
  all.reinit = params;
  const LevelSet<LagrangianReinit<>, D> set(
      support::box_of_ball<D>(48), [=](const Vec<D>& x) { return slope * support::OffCentreBall<D>()(x); }, all,
      Serial{});
  return support::distance_error(set.band(), within, support::OffCentreBall<D>());
}

/// True if a distance is off by more than `most` afterwards, or has zeros next to the walls, where there were none.
bool spoils_a_distance(int steps, double dtau, double most) {
  try {
    return error<2>(1.0, 3.0, {.iterations = steps, .dtau = dtau}) > most;
  } catch (const InterfaceError&) {
    return true;
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(slopes_next_to_the_interface_go_to_one) {
  // A slope g goes to g exp((1 - g) dtau) in a step: 1.5 -> 0.910 -> 0.996 -> 1.00001.
  constexpr double h = 2.0 / 48.0;
  BOOST_TEST(std::abs(error<2>(1.5, 1.0, {.iterations = 1}) / h - 0.09) < 0.03);
  BOOST_TEST(error<2>(1.5, 1.0, {.iterations = 3}) < 0.01 * h);
  BOOST_TEST(error<3>(1.5, 1.0, {.iterations = 3}) < 0.01 * h);
  // Beyond the stability limit of the step, 2, slopes keep jumping.
  BOOST_TEST(error<2>(1.5, 1.0, {.iterations = 3, .dtau = 2.5}) > 0.1 * h);
}

BOOST_AUTO_TEST_CASE(a_distance_does_not_stay_one) {
  // Perturbations of phi move off the interface at speed |phi|, which centred derivatives and steps of Euler's kind in
  // the velocity amplify, however small the steps: after 16 units of pseudo-time the distance is off by h.
  constexpr double h = 2.0 / 48.0;
  for (const double dtau : {0.2, 1.0}) {
    const int steps = static_cast<int>(std::round(16.0 / dtau));
    BOOST_TEST(error<2>(1.0, 3.0, {.iterations = 1, .dtau = dtau}) < 1e-4 * h);
    BOOST_TEST(spoils_a_distance(steps, dtau, 0.5 * h));
  }
}

BOOST_AUTO_TEST_CASE(same_bits_for_any_number_of_threads) {
  LevelSet<LagrangianReinit<>, 2>::Params all;
  all.reinit.iterations = 3;
  const LevelSet<LagrangianReinit<>, 2> one(support::box_of_ball<2>(48), support::ScaledBall<2>{4.0}, all, OpenMP{1});
  for (const int threads : {2, 3}) {
    const LevelSet<LagrangianReinit<>, 2> more(support::box_of_ball<2>(48), support::ScaledBall<2>{4.0}, all,
                                               OpenMP{threads});
    BOOST_TEST(support::same_bits(one.band(), more.band()));
  }
}

BOOST_AUTO_TEST_CASE(bad_options) {
  using Method = LagrangianReinit<>::Method<double, 2>;
  BOOST_CHECK_THROW(Method({.iterations = 0}), ValueError);
  BOOST_CHECK_THROW(Method({.dtau = -1.0}), ValueError);
  BOOST_CHECK_THROW(Method({.longest_shift = 0.0}), ValueError);
}
