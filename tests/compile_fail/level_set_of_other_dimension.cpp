// expect: cambium: a level set is made from a function of a position with as many dimensions as the lattice
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/shapes/ball.hpp>

#ifdef CAMBIUM_CONTROL
constexpr int dimension = 2;
#else
constexpr int dimension = 3;
#endif

int main() {
  cambium::LevelSet<cambium::ClosestPoint, dimension> level_set(
      cambium::Lattice<dimension>::bounded_box(cambium::Box<dimension>::cube(), 16),
      cambium::Ball<2>(cambium::Vec<2>::constant(0.5), 0.2));
}
