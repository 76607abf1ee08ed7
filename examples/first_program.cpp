// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <cambium/interpolation.hpp>
#include <cambium/kernels.hpp>
#include <cambium/time.hpp>

using namespace cambium;

int main() {
  const auto lattice = Lattice<2>::periodic_box(Box<2>::cube(), 64);
  const auto bump = [](const Vec<2>& x) { return std::exp(-100.0 * dot(x - Vec<2>{0.5, 0.7}, x - Vec<2>{0.5, 0.7})); };
  Particles<2> particles(lattice.size());  // one at every node, each with what is in its cell
  const auto mass = particles.add<double>("mass");
  for (std::size_t p = 0; p < particles.size(); ++p) {
    particles.positions().set(p, lattice.position(lattice.node(p)));
    particles[mass][p] = bump(particles.positions()[p]) * lattice.cell_volume();
  }
  RK4<Columns<2, double>> stepper;
  Remesher<M6> remesh({.threshold = 1e-12});
  for (int step = 0; step < 64; ++step) {  // one turn about the centre of the box
    stepper.step(particles.positions(), 0.0, 2.0 * std::numbers::pi / 64, [](auto x, double, auto velocity) {
      for (std::size_t p = 0; p < x.size(); ++p) velocity.set(p, {0.5 - x[p][1], x[p][0] - 0.5});
    });
    remesh(particles, lattice, mass);  // back to the nodes
  }
  double error = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    error = std::max(error, std::abs(particles[mass][p] / lattice.cell_volume() - bump(particles.positions()[p])));
  }
  std::printf("largest error after one turn: %.1e\n", error);
  return error < 1e-3 ? 0 : 1;
}
