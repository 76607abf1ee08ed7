// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <numbers>

#include <cambium/cambium.hpp>

using namespace cambium;

int main() {
  const auto lattice = Lattice<2>::periodic_box(Box<2>::cube(), 64);
  const auto bump = [](const Vec<2>& x) { return std::exp(-100.0 * dot(x - Vec<2>{0.5, 0.7}, x - Vec<2>{0.5, 0.7})); };
  auto density = sample(lattice, bump);

  Particles<2> particles(lattice.size());  // one at every node, each with what is in its cell
  const auto mass = particles.add<double>("mass");
  for (std::size_t p = 0; p < particles.size(); ++p) {
    particles.positions().set(p, lattice.position(lattice.node(p)));
    particles[mass][p] = density[p] * lattice.cell_volume();
  }

  RK4<Columns<2, double>> stepper;
  Remesher<M6> remesh({.threshold = 1e-12});
  for (int step = 0; step < 64; ++step) {  // one turn about the centre of the box
    stepper.step(particles.positions(), 0.0, 2.0 * std::numbers::pi / 64, [](auto x, double, auto velocity) {
      for (std::size_t p = 0; p < x.size(); ++p) velocity.set(p, {0.5 - x[p][1], x[p][0] - 0.5});
    });
    remesh(particles, lattice, mass);
  }

  p2m<M6>(particles, mass, density);
  double error = 0.0;
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const double exact = bump(lattice.position(lattice.node(i)));
    error = std::max(error, std::abs(density[i] / lattice.cell_volume() - exact));
  }
  std::printf("largest error after one turn: %.1e\n", error);
  return error < 1e-3 ? 0 : 1;
}
