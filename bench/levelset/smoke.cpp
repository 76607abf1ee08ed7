// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/levelset/reinit/fast_marching.hpp>
#include <cambium/levelset/reinit/linear_kick_off.hpp>

#include "levelset/reinitialisation.hpp"

/// Two reinitialisations in 2D and no advection, so that a test of the program compiles in seconds.
template <int D>
void bench::run_every_reinitialisation(ReinitScene<D>& scene) {
  scene.template run<cambium::ClosestPoint>("closest points", "ClosestPoint (Lambda44)");
  scene.template run<cambium::FastMarching<cambium::LinearKickOff, 1>>("marching and sweeping",
                                                                       "FastMarching 1, linear");
}
template void bench::run_every_reinitialisation(ReinitScene<2>& scene);

void bench::run_advections(const Options&, Rows&) {}
