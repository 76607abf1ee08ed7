// expect: cambium: only shapes of the same dimension can be combined
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/levelset/shapes/combination.hpp>

#ifdef CAMBIUM_CONTROL
using Other = cambium::Ball<2>;
#else
using Other = cambium::Ball<3>;
#endif

int main() { cambium::unite(cambium::Ball<2>({}, 1.0), Other({}, 1.0)); }
