// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/shapes/ball.hpp>

template <class Advection, class Velocity>
void step_by(const Velocity& velocity) {
  using namespace cambium;
  LevelSet<ClosestPoint, 2> level_set(Lattice<2>::bounded_box(Box<2>::cube(), 16), Ball<2>({0.5, 0.5}, 0.2));
  Advection().step(level_set, velocity, 0.0, 1.0);
}
