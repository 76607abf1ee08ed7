// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE surface_exchange
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include <cambium/levelset/shapes/ellipsoid.hpp>
#include <cambium/surface/surface_exchange.hpp>
#include <cambium/time/rk4.hpp>

#include "sphere_modes.hpp"
#include "support/order.hpp"

using namespace cambium;

namespace {

struct Outcome {
  double error, amplitude, total, area;
};

template <int D, class T>
LevelSet<ClosestPoint, D, T> sphere(std::ptrdiff_t cells) {
  return {modes::lattice<D>(cells), Ball<D>(modes::centre<D>(), 1.0)};
}

template <int D, class T, class E = OpenMP>
void diffuse(SurfaceExchange<D, T>& particles, AlignedVector<T>& strengths, double time, const E& execution = {}) {
  const double steps = std::ceil(time * particles.spectral_radius() / RK4<AlignedVector<T>>::real_axis);
  RK4<AlignedVector<T>, E> stepper(strengths, execution);
  for (int s = 0; s < steps; ++s) {
    stepper.step(strengths, 0.0, time / steps,
                 [&](const auto& y, double, auto& rate) { particles.exchange(y, rate, execution); });
  }
}

/// 1 + Y_l on the unit sphere until t = 0.1: error of the values within a spacing of the interface, over what is left
/// of the amplitude; of the amplitude; of the total; of the area.
template <int D, class T>
Outcome harmonic(int l, std::ptrdiff_t cells) {
  SurfaceExchange<D, T> particles(sphere<D, T>(cells));
  AlignedVector<T> strengths(particles.size());
  const auto mode = [&](const Vec<D>& x) { return modes::harmonic<D>(l, x - modes::centre<D>()); };
  particles.sample([&](const Vec<D>& x) { return 1.0 + mode(x); }, strengths);
  const double before = particles.total(strengths), left = std::exp(-0.1 * modes::eigenvalue<D>(l));
  diffuse(particles, strengths, 0.1);
  double error = 0.0, product = 0.0, square = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double exact = mode(particles.point(p)), volume = static_cast<double>(particles.volumes()[p]);
    const double strength = static_cast<double>(strengths[p]);
    product += exact * (strength - volume);
    square += exact * exact * volume;
    if (std::abs(particles.phi(p)) > particles.lattice().spacing()) continue;
    error = std::max(error, std::abs(strength / volume - 1.0 - left * exact) / left);
  }
  const double area = std::accumulate(particles.volumes().begin(), particles.volumes().end(), 0.0);
  return {error, std::abs(product / square / left - 1.0), std::abs(particles.total(strengths) / before - 1.0),
          std::abs(area / (2.0 * (D - 1) * std::numbers::pi) - 1.0)};
}

BOOST_AUTO_TEST_CASE(diffusion_on_the_sphere_converges) {
  const Outcome coarse = harmonic<3, double>(3, 24), fine = harmonic<3, double>(3, 36);
  BOOST_TEST_MESSAGE("values " << coarse.error << ", " << fine.error << "; amplitude " << coarse.amplitude << ", "
                               << fine.amplitude << "; area " << coarse.area << ", " << fine.area);
  // Values have errors of first order besides those of second: what the lattice does to a layer of fixed width.
  BOOST_TEST(support::observed_order(coarse.error, fine.error, 1.5) > 1.4);
  BOOST_TEST(support::observed_order(coarse.amplitude, fine.amplitude, 1.5) > 1.9);
  BOOST_TEST(support::observed_order(coarse.area, fine.area, 1.5) > 1.9);
  BOOST_TEST(fine.total < 1e-14);
}

BOOST_AUTO_TEST_CASE(single_precision_keeps_the_total) {
  const Outcome outcome = harmonic<2, float>(2, 48);
  BOOST_TEST(outcome.error < 0.02);
  BOOST_TEST(outcome.total < 1e-5);
}

BOOST_AUTO_TEST_CASE(exchange_is_symmetric_and_never_gives_energy) {
  const LevelSet<ClosestPoint, 2> shape(modes::lattice<2>(48), Ellipsoid<2>(modes::centre<2>(), {1.1, 0.7}));
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

BOOST_AUTO_TEST_CASE(what_does_not_fit_is_refused) {
  BOOST_CHECK_THROW(SurfaceExchange<2>({.half_width = 1.0}), ValueError);
  BOOST_CHECK_THROW(SurfaceExchange<2>({.binding = -1.0}), ValueError);
  // Band of 6 spacings, layer of 5: stencils of second differences would read what is cut off.
  BOOST_CHECK_THROW(SurfaceExchange<2>(sphere<2, double>(32), {.half_width = 5.0}), BandError);
  // Radius 1.5 spacings, layer of 3.
  const LevelSet<ClosestPoint, 2> dot(modes::lattice<2>(48), Ball<2>(modes::centre<2>(), 0.1));
  BOOST_CHECK_THROW(SurfaceExchange<2>{dot}, InterfaceError);
  SurfaceExchange<2> particles(sphere<2, double>(32));
  AlignedVector<double> few(3), rate(particles.size());
  BOOST_CHECK_THROW(particles.exchange(few, rate), SizeError);
}

}  // namespace
