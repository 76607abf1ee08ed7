// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE surface_particles
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <utility>

#include <cambium/surface/flux_laplacian.hpp>

#include "support/order.hpp"
#include "support/surface/particle_carrier.hpp"
#include "support/surface/rare_extension.hpp"

using namespace particles;
using modes::sampled;

namespace {

BOOST_AUTO_TEST_CASE(growing_circle_has_the_order_and_keeps_strengths) {
  const auto coarse = growing_sphere<2>(32, 3), fine = growing_sphere<2>(64, 6);
  BOOST_TEST_MESSAGE("errors " << coarse.error << ", " << fine.error << "; totals " << fine.totals);
  BOOST_TEST(support::observed_order(coarse.error, fine.error) > 1.9);
  BOOST_TEST(fine.totals < 1e-13);
}

// Numbers of 24 bits and a kernel of four points, whose error is larger; sums to the round-off of float.
BOOST_AUTO_TEST_CASE(growing_circle_of_floats_with_another_kernel_has_the_order) {
  const auto coarse = growing_sphere<2, float, M4Prime>(32, 3), fine = growing_sphere<2, float, M4Prime>(64, 6);
  BOOST_TEST_MESSAGE("errors " << coarse.error << ", " << fine.error << "; totals " << fine.totals);
  BOOST_TEST(support::observed_order(coarse.error, fine.error) > 1.8);
  BOOST_TEST(fine.totals < 1e-6);
}

BOOST_AUTO_TEST_CASE(growing_sphere_has_the_order) {
  const auto coarse = growing_sphere<3>(28, 2), fine = growing_sphere<3>(42, 3);
  BOOST_TEST_MESSAGE("errors " << coarse.error << ", " << fine.error << "; totals " << fine.totals);
  BOOST_TEST(support::observed_order(coarse.error, fine.error, 1.5) > 1.9);
  BOOST_TEST(fine.totals < 1e-13);
}

/// The map x_d -> x_d (1 + a_d t) turns the circle into an ellipse: c = c_0 dS_0 / dS, dS / dS_0 = det F |F^-T n_0|.
double ellipse_error(std::ptrdiff_t cells, int steps) {
  constexpr double rate[2] = {0.5, -0.3}, end = 0.5;
  const Vec<2> middle = modes::centre<2>();
  Carrier<2> carrier{unit_sphere_in<2>(2.05, cells)};
  const auto start = [&](const Vec<2>& x) { return 2.0 + modes::harmonic<2>(1, x - middle); };
  carrier.sample(start);
  for (int s = 0; s < steps; ++s) {
    carrier.move(
        [&](const Vec<2>& x, double t) {
          Vec<2> result;
          for (int d = 0; d < 2; ++d) result[d] = rate[d] / (1.0 + rate[d] * t) * (x[d] - middle[d]);
          return result;
        },
        end / steps);
  }
  // Nodes next to the interface have the value of their closest point, found by bisection of the ellipse's normal
  // angle.
  return carrier.error([&](const Vec<2>& x) {
    const double a = 1.0 + rate[0] * end, b = 1.0 + rate[1] * end;
    const Vec<2> y = x - middle;
    double angle = std::atan2(y[1] / b, y[0] / a);
    for (int k = 0; k < 50; ++k) {  // Newton for (y - q(angle)) . q'(angle) = 0
      const double co = std::cos(angle), si = std::sin(angle);
      const Vec<2> q{a * co, b * si}, dq{-a * si, b * co};
      angle += dot(y - q, dq) / (dot(dq, dq) + dot(y - q, q));
    }
    const Vec<2> origin{std::cos(angle), std::sin(angle)};
    return (2.0 + modes::harmonic<2>(1, origin)) / std::hypot(b * origin[0], a * origin[1]);
  });
}

BOOST_AUTO_TEST_CASE(ellipse_grown_by_a_known_map_has_the_order) {
  const double coarse = ellipse_error(48, 4), fine = ellipse_error(96, 8);
  BOOST_TEST_MESSAGE("errors " << coarse << ", " << fine);
  BOOST_TEST(support::observed_order(coarse, fine) > 1.9);
}

BOOST_AUTO_TEST_CASE(threads_give_the_same_bits) {
  Numbers<2> first(unit_sphere_in<2>(2.05, 32).lattice());
  for (const int threads : {1, 2, 3}) {
    Carrier<2> carrier{unit_sphere_in<2>(2.05, 32)};
    carrier.sample([](const Vec<2>& x) { return 1.0 + x[0]; });
    carrier.move([](const Vec<2>& x, double) { return 0.3 * x; }, 0.1, OpenMP{threads});
    if (threads == 1) first = carrier.c;
    for (std::size_t b = 0; b < first.blocks(); ++b) {
      BOOST_TEST(std::equal(first.block(b).begin(), first.block(b).end(), carrier.c.block(b).begin()));
    }
  }
}

BOOST_AUTO_TEST_CASE(fluxes_of_threads_have_the_same_bits_and_other_bands_are_refused) {
  const modes::Sphere sphere = modes::unit_sphere<3>(24), other = modes::unit_sphere<3>(32);
  const modes::Scalars c = sampled(sphere, [](const Vec<3>& x) { return x[0] + x[1] * x[2]; });
  FluxLaplacian<> fluxes;
  modes::Scalars one(sphere.lattice()), three(sphere.lattice());
  BOOST_CHECK_THROW(fluxes(sphere.band(), c, one), SizeError);
  fluxes.fit(sphere.band(), OpenMP{3});
  fluxes(sphere.band(), c, one, OpenMP{1});
  fluxes(sphere.band(), c, three, OpenMP{3});
  for (std::size_t b = 0; b < one.blocks(); ++b) {
    BOOST_TEST(std::equal(one.block(b).begin(), one.block(b).end(), three.block(b).begin()));
  }
  BOOST_CHECK_THROW(fluxes(other.band(), c, one), SizeError);
  BOOST_CHECK_THROW(fluxes.fit(NarrowBand<double, 3>(sphere.lattice(), 2.0 * sphere.spacing())), BandError);
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_is_refused) {
  BOOST_CHECK_THROW((SurfaceParticles<1, 2>({.substeps = 0})), ValueError);
  const Interface<2> circle = unit_sphere_in<2>(2.05, 32);
  SurfaceParticles<1, 2> particles;
  BOOST_CHECK_THROW(particles.take(circle, Numbers<2>(circle.lattice())), SizeError);
}

/// Of c = r Y_32, which is not constant along normals: div((1 - n n) grad c) = -12 c / r^2; and the sum of the rates.
template <class T>
Outcome flux_error(std::ptrdiff_t cells) {
  const Interface<3, T> sphere(modes::lattice<3>(cells), Ball<3>(modes::centre<3>(), 1.0));
  Numbers<3, T> c(sphere.lattice()), rate(sphere.lattice());
  take_blocks(c, sphere.band());
  for_each_node(c, [&](const Index<3>& node, T& value) {
    const Vec<3> x = sphere.lattice().position(node) - modes::centre<3>();
    value = static_cast<T>(norm(x) * modes::harmonic<3>(3, x) + x[0]);
  });
  FluxLaplacian<3, T> fluxes;
  fluxes.fit(sphere.band());
  fluxes(sphere.band(), c, rate);
  double worst = 0.0, sum = 0.0, size = 0.0;
  for_each_node(
      rate,
      [&](const Index<3>& node, const T& of_node) {
        const auto value = static_cast<double>(of_node);
        sum += value;
        size += std::abs(value);
        const Vec<3> x = sphere.lattice().position(node) - modes::centre<3>();
        if (std::abs(norm(x) - 1.0) > 2.0 * sphere.spacing()) return;
        const double exact = -12.0 * modes::harmonic<3>(3, x) / norm(x) - 2.0 * x[0] / dot(x, x);
        worst = std::max(worst, std::abs(value - exact));
      },
      Serial{});
  return {worst, std::abs(sum) / size};
}

BOOST_AUTO_TEST_CASE(fluxes_have_the_order_and_conserve) {
  const auto coarse = flux_error<double>(24), fine = flux_error<double>(48);
  BOOST_TEST_MESSAGE("errors " << coarse.error << ", " << fine.error << "; sums " << coarse.totals << ", "
                               << fine.totals);
  BOOST_TEST(support::observed_order(coarse.error, fine.error) > 1.7);
  BOOST_TEST(std::max(coarse.totals, fine.totals) < 1e-15);  // the coarse band reaches the box
  const auto floats = flux_error<float>(48);                 // the round-off of second differences, eps / h^2, is added
  BOOST_TEST(std::abs(floats.error - fine.error) < 40.0 * 6e-8 * 15.0 * 15.0);
  BOOST_TEST(floats.totals < 1e-8);
}

}  // namespace
