// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Particles that turn and are remeshed for as many steps as are asked for: soak_particles STEPS. For scripts/soak,
// which looks at its memory at every line.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include <cambium/interpolation.hpp>
#include <cambium/kernels.hpp>
#include <cambium/time.hpp>

using namespace cambium;

int main(int argc, char** argv) {
  const int steps = argc > 1 ? std::atoi(argv[1]) : 10000;
  const auto lattice = Lattice<2>::periodic_box(Box<2>::cube(), 48);
  Particles<2> particles(lattice.size());
  const auto mass = particles.add<double>("mass");
  double before = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vec<2> x = lattice.position(lattice.node(p));
    particles.positions().set(p, x);
    particles[mass][p] = std::exp(-100.0 * dot(x - Vec<2>{0.5, 0.7}, x - Vec<2>{0.5, 0.7})) * lattice.cell_volume();
    before += particles[mass][p];
  }
  RK4<Columns<2, double>> stepper;
  Remesher<M6> remesh({.threshold = 1e-12});
  for (int step = 1; step <= steps; ++step) {
    stepper.step(particles.positions(), 0.0, 2.0 * std::numbers::pi / 64, [](auto x, double, auto velocity) {
      for (std::size_t p = 0; p < x.size(); ++p) velocity.set(p, {0.5 - x[p][1], x[p][0] - 0.5});
    });
    remesh(particles, lattice, mass);
    if (step % 500 != 0) continue;
    double after = 0.0;
    for (const double value : particles[mass]) after += value;
    std::printf("step %d: mass changed by %.1e of it\n", step, after / before - 1.0);
    std::fflush(stdout);
    if (!(std::abs(after / before - 1.0) < 1e-9 * step)) return 1;  // 5e-11 a step here, of what the threshold drops
  }
  return 0;
}
