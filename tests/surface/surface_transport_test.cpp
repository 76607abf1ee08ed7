// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE surface_transport
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "support/order.hpp"
#include "support/surface/carrier.hpp"

using namespace motion;

namespace {

BOOST_AUTO_TEST_CASE(growing_circle_has_the_order) {
  const Outcome coarse = growing_sphere<2, 2>(32, 3), fine = growing_sphere<2, 2>(64, 6);
  BOOST_TEST_MESSAGE("errors " << coarse.error << ", " << fine.error << "; mass " << coarse.mass << ", " << fine.mass);
  BOOST_TEST(support::observed_order(coarse.error, fine.error) > 1.9);
  BOOST_TEST(support::observed_order(coarse.mass, fine.mass) > 1.9);
}

/// The map x_d -> x_d (1 + a_d t) turns the circle into an ellipse: c = c_0 dS_0 / dS, dS / dS_0 = det F |F^-T n_0|.
template <int Order, int D>
double ellipsoid_error(std::ptrdiff_t cells, int steps) {
  const Vec<D> centre = modes::centre<D>();
  constexpr double rate[3] = {0.5, -0.3, 0.2}, end = 0.5;
  Carrier<Order, D> carrier{unit_sphere<D>(1.9, cells)};
  const auto start = [&](const Vec<D>& x) { return 2.0 + modes::harmonic<D>(1, x - centre); };
  carrier.band.sample(start, carrier.c);
  for (int s = 0; s < steps; ++s) {
    const auto u = [&](const Vec<D>& x, double t) {
      Vec<D> result;
      for (int d = 0; d < D; ++d) result[d] = rate[d] / (1.0 + rate[d] * t) * (x[d] - centre[d]);
      return result;
    };
    carrier.move(u, end / steps);
  }
  return carrier.error([&](const Vec<D>& x) {
    Vec<D> origin = x - centre, normal;
    double determinant = 1.0;
    for (int d = 0; d < D; ++d) {
      origin[d] /= 1.0 + rate[d] * end;
      determinant *= 1.0 + rate[d] * end;
    }
    for (int d = 0; d < D; ++d) normal[d] = origin[d] / (norm(origin) * (1.0 + rate[d] * end));
    return start(centre + origin) / (determinant * norm(normal));
  });
}

BOOST_AUTO_TEST_CASE(ellipse_grown_by_a_known_map_has_the_order) {
  const double coarse = ellipsoid_error<2, 2>(48, 4), fine = ellipsoid_error<2, 2>(96, 8);
  BOOST_TEST_MESSAGE("errors " << coarse << ", " << fine);
  BOOST_TEST(support::observed_order(coarse, fine) > 1.9);
}

BOOST_AUTO_TEST_CASE(threads_give_the_same_bits) {
  Values first;
  for (const int threads : {1, 2, 3}) {
    Carrier<2, 2> carrier{unit_sphere<2>(1.9, 48)};
    carrier.band.sample([](const Vec<2>& x) { return 1.0 + x[0]; }, carrier.c);
    carrier.move([](const Vec<2>& x, double) { return 0.3 * x; }, 0.1, OpenMP{threads});
    if (threads == 1) first = carrier.c;
    BOOST_TEST((carrier.c == first));
  }
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_is_refused) {
  BOOST_CHECK_THROW((SurfaceTransport<>({.substeps = 0})), ValueError);
  Carrier<2, 2> carrier{unit_sphere<2>(1.9, 32)};
  const auto still = [](const Vec<2>&, double) { return Vec<2>{}; };
  Values few(3);
  BOOST_CHECK_THROW(carrier.transport(carrier.band, few, still, 0.0, 0.1, carrier.band, carrier.c), SizeError);
  // The new interface is not where the velocity leads.
  const auto away = [](const Vec<2>&, double) { return Vec<2>{0.5, 0.0}; };
  carrier.carried.resize(carrier.band.size());
  BOOST_CHECK_THROW(carrier.transport(carrier.band, carrier.c, away, 0.0, 1.0, carrier.band, carrier.carried),
                    BandError);
}

}  // namespace
