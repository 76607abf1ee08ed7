// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE surface_exchange
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include <cambium/levelset/shapes/ellipsoid.hpp>

#include "support/count_allocations.hpp"
#include "support/order.hpp"
#include "support/surface/exchange_modes.hpp"

using namespace modes;

namespace {

BOOST_AUTO_TEST_CASE(diffusion_on_the_sphere_converges) {
  const Outcome coarse = decay<3, double>(3, 24), fine = decay<3, double>(3, 36);
  BOOST_TEST_MESSAGE("values " << coarse.error << ", " << fine.error << "; amplitude " << coarse.amplitude << ", "
                               << fine.amplitude << "; area " << coarse.area << ", " << fine.area);
  // Values have errors of first order besides those of second: what the lattice does to a layer of fixed width.
  BOOST_TEST(support::observed_order(coarse.error, fine.error, 1.5) > 1.4);
  BOOST_TEST(support::observed_order(coarse.amplitude, fine.amplitude, 1.5) > 1.9);
  BOOST_TEST(support::observed_order(coarse.area, fine.area, 1.5) > 1.9);
  BOOST_TEST(fine.total < 1e-14);
}

BOOST_AUTO_TEST_CASE(single_precision_keeps_the_total) {
  const Outcome outcome = decay<2, float>(2, 48);
  BOOST_TEST(outcome.error < 0.02);
  BOOST_TEST(outcome.total < 1e-5);
}

BOOST_AUTO_TEST_CASE(exchange_is_symmetric_and_never_gives_energy) {
  const LevelSet<ClosestPoint, 2> shape(lattice<2>(48), Ellipsoid<2>(centre<2>(), {1.1, 0.7}));
  SurfaceExchange<2> particles(shape);
  AlignedVector<double> a(particles.size()), b(a), rate_a(a), rate_b(a);
  for (std::size_t p = 0; p < a.size(); ++p) {
    a[p] = particles.volumes()[p] * std::sin(1.0 + 7.0 * static_cast<double>(p * p % 101));
    b[p] = particles.volumes()[p] * std::cos(3.0 * static_cast<double>(p * p % 89));
  }
  particles.exchange(a, rate_a);
  particles.exchange(b, rate_b);
  double ab = 0.0, ba = 0.0, aa = 0.0, size = 0.0, scale = 0.0, mass = 0.0;
  for (std::size_t p = 0; p < a.size(); ++p) {
    const double v = particles.volumes()[p];
    ab += a[p] / v * rate_b[p];
    ba += b[p] / v * rate_a[p];
    aa += a[p] / v * rate_a[p];
    size += a[p] * a[p] / v;
    scale += std::abs(rate_a[p]);
    mass += rate_a[p];
  }
  BOOST_TEST(std::abs(ab - ba) < 1e-12 * std::abs(aa));
  BOOST_TEST(std::abs(mass) < 1e-13 * scale);
  BOOST_TEST(aa < 0.0);
  BOOST_TEST(-aa <= particles.spectral_radius() * size);
}

BOOST_AUTO_TEST_CASE(threads_give_the_same_bits) {
  SurfaceExchange<2> particles(sphere<2, double>(48));
  AlignedVector<double> first;
  for (const int threads : {1, 2, 3}) {
    AlignedVector<double> strengths(particles.size());
    particles.sample([](const Vec<2>& x) { return 2.0 + x[0]; }, strengths);
    diffuse(particles, strengths, 0.01, OpenMP{threads});
    if (threads == 1) first = strengths;
    BOOST_TEST((strengths == first));
  }
}

BOOST_AUTO_TEST_CASE(exchange_allocates_nothing) {
  SurfaceExchange<2> particles(sphere<2, double>(32));
  AlignedVector<double> strengths(particles.size(), 1.0), rate(particles.size());
  const std::size_t before = support::allocations;
  particles.exchange(strengths, rate, Serial{});
  BOOST_TEST(support::allocations == before);
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_is_refused) {
  BOOST_CHECK_THROW(SurfaceExchange<2>({.half_width = 1.0}), ValueError);
  BOOST_CHECK_THROW(SurfaceExchange<2>({.binding = -1.0}), ValueError);
  // Band of 6 spacings, layer of 5: stencils of second differences would read what is cut off.
  BOOST_CHECK_THROW(SurfaceExchange<2>(sphere<2, double>(32), {.half_width = 5.0}), BandError);
  // Radius 1.5 spacings, layer of 3.
  const LevelSet<ClosestPoint, 2> dot(lattice<2>(48), Ball<2>(centre<2>(), 0.1));
  BOOST_CHECK_THROW(SurfaceExchange<2>{dot}, InterfaceError);
  SurfaceExchange<2> particles(sphere<2, double>(32));
  AlignedVector<double> few(3), rate(particles.size());
  BOOST_CHECK_THROW(particles.exchange(few, rate), SizeError);
}

}  // namespace
