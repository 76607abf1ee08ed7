// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/advection.hpp"

#include <cambium/levelset/advection/backward.hpp>
#include <cambium/levelset/advection/eulerian.hpp>
#include <cambium/levelset/advection/lagrangian.hpp>
#include <cambium/levelset/advection/particle_corrected.hpp>
#include <cambium/levelset/reinit/pde_reinit.hpp>

#include "levelset/dense_band.hpp"
#include "openvdb/openvdb.hpp"

using namespace cambium;

namespace bench {
namespace {

void backward(std::ptrdiff_t cells, int steps, const Options& options, Rows& rows) {
  const std::string name = "Backward, " + std::to_string(steps) + " steps";
  // 48 steps of RK4 in all.
  advect<ClosestPoint>(
      "Backward", name, cells, steps, Backward<>({.substeps = 48 / steps}), {},
      [](const AdvectionReport& report) { return report.steps; }, options, rows);
}
void lagrangian(std::ptrdiff_t cells, int steps, const Options& options, Rows& rows) {
  const std::string name = "Lagrangian, " + std::to_string(steps) + " steps";
  advect<ClosestPoint>(
      "Lagrangian", name, cells, steps, Lagrangian<>(), {},
      [](const LagrangianReport& report) { return report.remeshings; }, options, rows);
}
/// Reinitialised by PDE after every ten sub-steps with the fix that keeps the interface in place. Of seven settings
/// tried at 64 cells (after every sub-step, every ten or never; 4 iterations or as many as the band needs; with or
/// without the fix, but not all combinations) it ends nearest to the ball.
void eulerian(std::ptrdiff_t cells, const Options& options, Rows& rows) {
  advect<PdeReinit<WENO5>>(
      "Eulerian", "Eulerian, WENO5 and RK3", cells, 12, Eulerian<>({.cfl = 0.9, .reinitialise_every = 10}),
      {.reinit = {.subcell_fix = SubcellFix::high_order}}, [](const EulerianReport& report) { return report.substeps; },
      options, rows);
}
void particle_corrected(std::ptrdiff_t cells, int steps, const Options& options, Rows& rows) {
  const std::string name = "ParticleCorrected, " + std::to_string(steps) + " steps";
  advect<ClosestPoint>(
      "ParticleCorrected", name, cells, steps, ParticleCorrected<>(), {},
      [](const ParticleCorrectedReport&) { return std::size_t{1}; }, options, rows);
}

#if WITH_OPENVDB
void openvdb(std::ptrdiff_t cells, const Options& options, Rows& rows) {
  const std::string name = "OpenVDB, HJWENO5";
  if (name.find(options.only) == std::string::npos) return;
  const auto lattice = deformation_lattice(cells);
  vdb::Values start{{cells + 1, cells + 1, cells + 1}, lattice.spacing(), {}};
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    start.phi.push_back(Deformation::distance(lattice.position(lattice.node(k))));
  }
  const vdb::Advected moved = vdb::advect_deformation(start);
  DeformationErrors errors("OpenVDB", name, cells);
  const double width = 6.0 * lattice.spacing();
  errors.half(dense_band(lattice, width, moved.half.phi));
  errors.end(dense_band(lattice, width, moved.end.phi));
  errors.enter(rows, moved.steps, moved.steps, moved.seconds);
}
#endif

}  // namespace

void run_advections(const Options& options, Rows& rows) {
  for (const std::ptrdiff_t cells : options.advection_cells) {
#if WITH_OPENVDB
    openvdb(cells, options, rows);
#endif
    for (const int steps : {12, 24, 48}) backward(cells, steps, options, rows);
  }
  for (const std::ptrdiff_t cells : options.advection_cells) {
    eulerian(cells, options, rows);
    particle_corrected(cells, 24, options, rows);
    lagrangian(cells, 24, options, rows);
  }
}

}  // namespace bench
