// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/models/tumour.hpp>

/// Balls of tissue and how they grow.
namespace scenes {

using namespace cambium;

template <int D>
Lattice<D> lattice(std::ptrdiff_t cells) {
  return Lattice<D>::bounded_box({Vec<D>::constant(-4.5), Vec<D>::constant(4.5)}, cells);
}
template <int D>
Vec<D> centre() {
  return Vec<D>::constant(0.02) + Vec<D>::unit(0, 0.03);
}
template <int D>
Ball<D> ball(double radius) {
  return {centre<D>(), radius};
}
/// Radius of the ball of the tumour's volume.
template <class Tumour>
double radius_of(const Tumour& tumour) {
  constexpr int D = Tumour::dimension;
  const double volume = measures(tumour.level_set().band()).volume;
  return D == 2 ? std::sqrt(volume / std::numbers::pi) : std::cbrt(0.75 * volume / std::numbers::pi);
}
/// Relative error of R(end), R(0) = 2. R(t) is the same for all tensions and both conditions outside; a small one
/// leaves explicit steps to the CFL number.
template <class Tumour>
double radius_error(std::ptrdiff_t cells, double end, double exact, double tension = 0.005) {
  constexpr int D = Tumour::dimension;
  Tumour tumour(lattice<D>(cells), ball<D>(2.0), {.parameters = {.tension = tension}});
  while (tumour.time() < end) {
    const TumourStep step = tumour.step(end - tumour.time());
    BOOST_REQUIRE(step.dt > 0.0);
    if (end - tumour.time() < 1e-12) break;
  }
  const double error = radius_of(tumour) / exact - 1.0;
  BOOST_TEST_MESSAGE(D << "D, " << cells << " cells: " << error);
  return error;
}

}  // namespace scenes
