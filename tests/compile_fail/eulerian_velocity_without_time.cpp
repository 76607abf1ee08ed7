// expect: cambium: the velocity of a level set is called as velocity\(x, time\)
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/levelset/advection/eulerian.hpp>

#include "compile_fail/step_by.hpp"

int main() {
#ifdef CAMBIUM_CONTROL
  step_by<cambium::Eulerian<>>([](const cambium::Vec<2>& x, double) { return x; });
#else
  step_by<cambium::Eulerian<>>([](const cambium::Vec<2>& x) { return x; });
#endif
}
