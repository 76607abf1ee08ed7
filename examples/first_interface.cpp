// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <numbers>

#include <cambium/levelset.hpp>

using namespace cambium;

int main() {
  const auto lattice = Lattice<3>::bounded_box(Box<3>::cube(), 64);
  LevelSet<ClosestPoint, 3> drop(lattice, blend(Ball<3>({0.4, 0.7, 0.5}, 0.12), Ball<3>({0.6, 0.7, 0.5}, 0.1), 0.05));
  const Measures<3> start = measures(drop.band());

  Backward<> advection;  // long steps: four to a turn about the centre of the box
  const auto turn = [](const Vec<3>& x, double) { return Vec<3>{0.5 - x[1], x[0] - 0.5, 0.0}; };
  const double quarter = 0.5 * std::numbers::pi;
  for (int step = 0; step < 4; ++step) advection.step(drop, turn, step * quarter, quarter);

  const Measures<3> end = measures(drop.band());
  std::printf("volume %.6f, area %.6f, curvature up to %.2f\n", end.volume, end.area, end.greatest_curvature);
  std::printf("volume changed by %.1e, area by %.1e\n", end.volume / start.volume - 1.0, end.area / start.area - 1.0);
  return std::abs(end.volume / start.volume - 1.0) < 1e-4 ? 0 : 1;
}
