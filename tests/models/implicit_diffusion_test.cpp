// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE implicit_diffusion
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <support/order.hpp>
#include <type_traits>
#include <vector>

#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/models.hpp>
#include <cambium/models/implicit_diffusion.hpp>
#include <cambium/reaction.hpp>

using namespace cambium;

namespace {

/// dc/dt = c + Lap c: Y decays at (l^2 - 1) on the unit circle.
struct Growing {
  static constexpr int species = 1;
  Vec<1> operator()(const Vec<1>& c) const { return c; }
};

LevelSet<ClosestPoint, 2> circle(std::ptrdiff_t cells) {
  return {Lattice<2>::bounded_box({{-1.6, -1.6}, {1.6, 1.6}}, cells), Ball<2>({0.013, 0.002}, 1.0)};
}

template <class K, class Steps>
using Pattern = SurfacePattern<K, FixedSurface, Steps, SurfaceLaplacian<2>, 2>;

template <class P>
std::vector<double> state(const P& pattern) {
  return {pattern.concentration(0).begin(), pattern.concentration(0).end()};
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}

/// cos(2 theta) until t = 0.5 in steps of one length; the same system of the band by RKC2 is the reference.
std::vector<double> decayed(double step) {
  Pattern<Growing, ImplicitDiffusion<>> pattern(
      circle(64), Growing{}, Vec<1>{1.0}, FixedSurface{},
      {.steps = {.absolute = 1e6, .relative = 0.0, .first = step, .largest = step}});
  pattern.sample([](const Vec<2>& x) { return Vec<1>{std::cos(2.0 * std::atan2(x[1] - 0.002, x[0] - 0.013))}; });
  pattern.advance(0.5);
  return state(pattern);
}

}  // namespace

BOOST_AUTO_TEST_CASE(its_order_is_that_of_its_tableau) {
  Pattern<Growing, StabilisedSteps> reference(circle(64), Growing{}, Vec<1>{1.0}, FixedSurface{},
                                              {.steps = {.absolute = 1e-9, .relative = 0.0}});
  reference.sample([](const Vec<2>& x) { return Vec<1>{std::cos(2.0 * std::atan2(x[1] - 0.002, x[0] - 0.013))}; });
  reference.advance(0.5);
  const double coarse = largest_difference(decayed(0.125), state(reference));
  const double fine = largest_difference(decayed(0.0625), state(reference));
  BOOST_TEST_MESSAGE("errors " << coarse << ", " << fine);
  BOOST_TEST(support::observed_order(coarse, fine) > 2.7);
  BOOST_TEST(fine < 1e-3);
}

// The steps of the tolerance are far above Euler's limit, 2 / (D times the spectral radius), and none ends beyond all
// bounds while spots grow out of noise.
BOOST_AUTO_TEST_CASE(a_pattern_is_that_of_stabilised_steps) {
  constexpr Vec<2> diffusivity{0.516 * 0.088 * 0.28, 0.088 * 0.28};
  const auto noise = [](const Vec<2>& x) {
    return Vec<2>{0.01 * std::sin(3.0 * x[0] + 1.0) + 0.01 * std::cos(4.0 * std::atan2(x[1], x[0])), 0.0};
  };
  const auto run = [&]<class Steps>(std::type_identity<Steps>, double tolerance, AdaptiveReport& report) {
    Pattern<LinearisedBrusselator, Steps> pattern(circle(40), varea_spots, diffusivity, FixedSurface{},
                                                  {.steps = {.absolute = tolerance, .relative = tolerance}});
    pattern.sample(noise);
    report = pattern.advance(100.0);
    return state(pattern);
  };
  AdaptiveReport implicit_report, explicit_report;
  const auto c = run(std::type_identity<ImplicitDiffusion<>>{}, 1e-4, implicit_report);
  const auto reference = run(std::type_identity<StabilisedSteps>{}, 1e-5, explicit_report);
  const auto [low, high] = std::ranges::minmax(reference);
  BOOST_TEST_MESSAGE("off by " << largest_difference(c, reference) << " of " << high - low << " in "
                               << implicit_report.steps << " steps; RKC2 " << explicit_report.steps);
  BOOST_TEST(high - low > 0.01);
  BOOST_TEST(largest_difference(c, reference) < 0.02 * (high - low));
  const double euler = 2.0 * 3.2 * 3.2 / (40.0 * 40.0 * 8.0 * diffusivity[1]);  // 2 / (8 D / h^2)
  BOOST_TEST(100.0 / static_cast<double>(implicit_report.steps) > 4.0 * euler);
}
