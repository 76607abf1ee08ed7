// expect: cambium: the velocity of a level set is called as velocity\(x, time\)
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/levelset/advection/backward.hpp>
#include <cambium/levelset/shapes/ball.hpp>

int main() {
  using namespace cambium;
  LevelSet<ClosestPoint, 2> level_set(Lattice<2>::bounded_box(Box<2>::cube(), 16), Ball<2>({0.5, 0.5}, 0.2));
#ifdef CAMBIUM_CONTROL
  const auto velocity = [](const Vec<2>& x, double) { return x; };
#else
  const auto velocity = [](const Vec<2>& x) { return x; };
#endif
  Backward<>().step(level_set, velocity, 0.0, 1.0);
}
