// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/m6.hpp>
#include <cambium/levelset/reinit/chopp_kick_off.hpp>
#include <cambium/levelset/reinit/fast_marching.hpp>
#include <cambium/levelset/reinit/fast_sweeping.hpp>
#include <cambium/levelset/reinit/gradient_normalised.hpp>
#include <cambium/levelset/reinit/group_marching.hpp>
#include <cambium/levelset/reinit/lagrangian_reinit.hpp>
#include <cambium/levelset/reinit/linear_kick_off.hpp>
#include <cambium/levelset/reinit/pde_reinit.hpp>
#include <cambium/levelset/reinit/upwind_lagrangian_reinit.hpp>

#include "levelset/reinitialisation.hpp"

namespace bench {

template <int D>
void run_every_reinitialisation(ReinitScene<D>& scene) {
  using namespace cambium;
  const char* family = "closest points";
  scene.template run<ClosestPoint>(family, "ClosestPoint (Lambda44)");
  scene.template run<BasicClosestPoint<Lambda<6, 4>>>(family, "closest points, Lambda64");
  scene.template run<BasicClosestPoint<M6>>(family, "closest points, M6");
  family = "marching and sweeping";
  scene.template run<FastMarching<ChoppKickOff, 2>>(family, "FastMarching 2, Chopp");
  scene.template run<FastMarching<ChoppKickOff, 1>>(family, "FastMarching 1, Chopp");
  scene.template run<FastMarching<LinearKickOff, 2>>(family, "FastMarching 2, linear");
  scene.template run<FastMarching<LinearKickOff, 1>>(family, "FastMarching 1, linear");
  scene.template run<FastSweeping<ChoppKickOff>>(family, "FastSweeping, Chopp");
  scene.template run<FastSweeping<LinearKickOff>>(family, "FastSweeping, linear");
  scene.template run<GroupMarching<ChoppKickOff>>(family, "GroupMarching, Chopp");
  scene.template run<GroupMarching<LinearKickOff>>(family, "GroupMarching, linear");
  family = "PDE";
  scene.template run<PdeReinit<WENO5>>(family, "PDE WENO5");
  scene.template run<PdeReinit<WENO3>>(family, "PDE WENO3");
  scene.template run<PdeReinit<ENO2>>(family, "PDE ENO2");
  scene.template run<PdeReinit<WENO5>>(family, "PDE WENO5, volume constraint", {.volume_constraint = true});
  scene.template run<PdeReinit<WENO5>>(family, "PDE WENO5, Russo-Smereka", {.subcell_fix = SubcellFix::russo_smereka});
  scene.template run<PdeReinit<ENO2>>(family, "PDE ENO2, high-order fix", {.subcell_fix = SubcellFix::high_order});
  scene.template run<PdeReinit<WENO5>>(family, "PDE WENO5, high-order fix", {.subcell_fix = SubcellFix::high_order});
  scene.template run<GradientNormalised>(family, "GradientNormalised");
  family = "Lagrangian";
  scene.template run<LagrangianReinit<>>(family, "LagrangianReinit");
  scene.template run<UpwindLagrangianReinit<>>(family, "UpwindLagrangianReinit");
}

}  // namespace bench
