// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

#include "tumour/boundary_integral.hpp"
#include "tumour/verification.hpp"

namespace bench {
namespace {

using nlohmann::json;

/// A figure, what it is to be, and how far off it may be.
json figure(const char* scene, bool free_space, int points, double found, double exact, double allowed) {
  const double error = found / exact - 1.0;
  const char* outside = free_space ? "FreeSpace" : "ZeroOutside";
  std::printf("reference %-10s %-11s %3d points  %.10f (%.10f), off by %9.2e\n", scene, outside, points, found, exact,
              error);
  if (!(std::abs(error) <= allowed)) throw std::runtime_error("the integral equations are off by more than they may");
  return {{"scene", scene}, {"outside", outside}, {"points", points}, {"found", found}, {"error", error}};
}

/// What the speed has of cos(l theta) on r = 2 + delta cos(l theta).
double share_of_mode(const BoundaryIntegral& solver, int l, double delta) {
  const auto curve = equidistant(solver.grid(), [&](double theta) { return 2.0 + delta * std::cos(l * theta); });
  const auto v = solver.speed(curve);
  double share = 0.0;
  for (int j = 0; j < curve.x.size(); ++j) {
    const double r = std::hypot(curve.x[j], curve.y[j]);
    const double across = (curve.x[j] * curve.nx()[j] + curve.y[j] * curve.ny()[j]) / r;
    const double turn = across * curve.speed[j] / r * solver.grid().step();  // d theta
    share += v[j] * std::cos(l * std::atan2(curve.y[j], curve.x[j])) * turn / std::numbers::pi;
  }
  return share;
}

}  // namespace

json verify_reference(const TumourOptions& options) {
  // Linear stability, R = 2, A = 0.5, G = 20, gamma = 1: l = 2..4; errors of the difference quotient are O(delta^2).
  constexpr double rates[2][3] = {{-0.992547722405, -4.23872133296, -10.0917895906},
                                  {0.492599428618, -0.141614086840, -2.07927492585}};
  constexpr double delta = 1e-3;
  json runs = json::array();
  for (const bool free_space : {false, true}) {
    const BoundaryIntegral solver(48, {.free_space = free_space});
    for (int l = 2; l <= 4; ++l) {
      const double found = (share_of_mode(solver, l, delta) - share_of_mode(solver, l, -delta)) / (2.0 * delta);
      runs.push_back(figure("rate", free_space, 48, found, rates[free_space ? 1 : 0][l - 2], 2e-5));
    }
    const BoundaryIntegral coarse(24, {.free_space = free_space});
    const auto disc = coarse.run(equidistant(coarse.grid(), [](double) { return 2.0; }), 0.2, 64);
    const double radius = std::sqrt(disc.area / std::numbers::pi);
    runs.push_back(figure("disc", free_space, 24, radius, 2.63637483481, 1e-8));
    for (const int points : options.smoke ? std::vector{32} : std::vector{32, 48, 64}) {
      const BoundaryIntegral finer(points, {.free_space = free_space});
      const auto start = equidistant(finer.grid(), elliptic);
      const auto end = finer.run(start, 1.0, finer.stable_steps(start, 1.0));
      runs.push_back(figure("ellipse", free_space, points, end.area, free_space ? 35.1559652 : 36.1939071, 1e-5));
    }
  }
  return runs;
}

}  // namespace bench
