// expect: cambium: a reinitialisation has its options in a nested type Params
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/shapes/ball.hpp>

#ifdef CAMBIUM_CONTROL
using Way = cambium::ClosestPoint;
#else
using Way = cambium::Ball<2>;  // the shape goes into the constructor
#endif

int main() {
  cambium::LevelSet<Way, 2> level_set(cambium::Lattice<2>::bounded_box(cambium::Box<2>::cube(), 16),
                                      cambium::Ball<2>({0.5, 0.5}, 0.2));
}
