// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE tumour_nutrient
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <tuple>

#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/models/tumour/diffusing.hpp>

#include "support/order.hpp"

using namespace cambium;

namespace {

template <int D>
using Dimension = std::integral_constant<int, D>;
using Dimensions = std::tuple<Dimension<2>, Dimension<3>>;

/// Regular radial solution of Lap c = k^2 c, 1 at r = 0, and its slope.
template <int D>
double radial(double k, double r) {
  if constexpr (D == 2) return std::cyl_bessel_i(0.0, k * r);
  return r > 0.0 ? std::sinh(k * r) / (k * r) : 1.0;
}
template <int D>
double radial_slope(double k, double r) {
  if constexpr (D == 2) return k * std::cyl_bessel_i(1.0, k * r);
  return (k * r * std::cosh(k * r) - std::sinh(k * r)) / (k * r * r);
}

/// A ball at rest in which the slowest mode decays: c = phi(r) / phi(R) - exp(-(1 + q^2) t) J(q r) / 2, J(q R) = 0.
template <int D>
struct Decay {
  static constexpr double radius(double) { return 1.2; }
  static double exact(double r, double t) {
    const double q = (D == 2 ? 2.404825557695773 : std::numbers::pi) / radius(t);
    const double mode = D == 2 ? std::cyl_bessel_j(0.0, q * r) : r > 0.0 ? std::sin(q * r) / (q * r) : 1.0;
    return radial<D>(1.0, r) / radial<D>(1.0, radius(t)) - 0.5 * std::exp(-(1.0 + q * q) * t) * mode;
  }
};
/// A ball that grows as c = exp((k^2 - 1) t) phi(k r) / phi(k R_0) says by being 1 on the interface: k < 1, speeds are
/// those of tumours (3.4 in the plane).
template <int D>
struct Growth {
  static constexpr double k = 0.5, start = 2.0;
  static double exact(double r, double t) {
    return std::exp((k * k - 1.0) * t) * radial<D>(k, r) / radial<D>(k, start);
  }
  static double radius(double t) {
    double r = start;
    for (int i = 0; i < 20; ++i) {  // Newton
      r -= (radial<D>(k, r) / radial<D>(k, start) - std::exp((1.0 - k * k) * t)) * radial<D>(k, start) /
           radial_slope<D>(k, r);
    }
    return r;
  }
};

template <int D>
Vec<D> centre() {
  return Vec<D>::constant(0.02) + Vec<D>::unit(0, 0.03);
}

struct Errors {
  double largest = 0.0;  ///< of c inside, at the end
  double middle = 0.0;   ///< at the node in the middle
};

/// \param ratio  of every second step to the one before
template <class Case, int D>
Errors errors(std::ptrdiff_t cells, int steps, double end, double ratio = 1.0) {
  const auto box = Lattice<D>::bounded_box({Vec<D>::constant(-3.6), Vec<D>::constant(3.6)}, cells);
  Diffusing::Method<D> nutrient(box, OpenMP{});
  Field<double, D> c(box, 1.0);
  double time = 0.0;
  Errors result;
  const auto at_all = [&](const auto& band, auto&& f) {
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Index<D> node = box.node(i);
      if (band(node) < 0.0) f(c[i], Case::exact(norm(box.position(node) - centre<D>()), time));
    }
  };
  for (int n = 0; n <= steps; ++n) {
    const double dt = n == 0 ? std::numeric_limits<double>::infinity()
                             : 2.0 * end / steps * (n % 2 != 0 ? 1.0 : ratio) / (1.0 + ratio);
    time += n == 0 ? 0.0 : dt;
    const LevelSet<ClosestPoint, D> level_set(box, Ball<D>(centre<D>(), Case::radius(time)));
    nutrient.solve(level_set.band(), dt, c);
    if (n == 0) at_all(level_set.band(), [](double& value, double exact) { value = exact; });
    nutrient.accept(c);
    if (n < steps) continue;
    at_all(level_set.band(),
           [&](double value, double exact) { result.largest = std::max(result.largest, std::abs(value - exact)); });
  }
  const Index<D> middle = Index<D>::constant(cells / 2);
  result.middle = c(middle) - Case::exact(norm(box.position(middle) - centre<D>()), time);
  BOOST_TEST_MESSAGE(D << "D, " << cells << " cells, " << steps << " steps: " << result.largest << ' '
                       << result.middle);
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(nutrient_in_a_ball_at_rest_is_of_second_order_in_time, N, Dimensions) {
  constexpr int D = N::value;
  const auto at = [](int steps, double ratio) {
    return errors<Decay<D>, D>(D == 2 ? 24 : 16, steps, 0.4, ratio).middle;
  };
  for (const double ratio : {1.0, 1.8}) {
    if (D == 3 && ratio == 1.0) continue;
    const double few = at(16, ratio), more = at(32, ratio), many = at(64, ratio);
    BOOST_TEST(support::observed_order(std::abs(few - more), std::abs(more - many)) > 1.75);
  }
}
BOOST_AUTO_TEST_CASE(and_in_space) {
  const auto at = [](std::ptrdiff_t cells) { return errors<Decay<2>, 2>(cells, 48, 0.4).largest; };
  BOOST_TEST(support::observed_order(at(16), at(48), 3.0) > 1.6);  // the coarse ball is 3 spacings in radius
}
BOOST_AUTO_TEST_CASE_TEMPLATE(tissue_that_an_interface_uncovers_joins_at_second_order, N, Dimensions) {
  constexpr int D = N::value;
  const std::ptrdiff_t cells = D == 2 ? 64 : 32;
  const double end = D == 2 ? 0.15 : 0.12;
  const Errors few = errors<Growth<D>, D>(cells, 4, end), many = errors<Growth<D>, D>(cells, 8, end);
  BOOST_TEST(support::observed_order(few.largest, many.largest) > 1.75);
}
