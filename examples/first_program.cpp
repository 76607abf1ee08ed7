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

  Particles<2> particles(lattice.size());  // one on each node
  const auto strength = particles.add<double>("strength");
  for (std::size_t p = 0; p < particles.size(); ++p) {
    particles.positions().set(p, lattice.position(lattice.node(p)));
    particles[strength][p] = bump(particles.positions()[p]);
  }

  RK4<Columns<2, double>> stepper;
  Remesher<M6> remesh;
  for (int step = 0; step < 64; ++step) {  // one turn about the centre of the box
    stepper.step(particles.positions(), 0.0, 2.0 * std::numbers::pi / 64, [](auto x, double, auto velocity) {
      for (std::size_t p = 0; p < x.size(); ++p) velocity.set(p, {0.5 - x[p][1], x[p][0] - 0.5});
    });
    remesh(particles, lattice, strength);
  }

  double error = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    error = std::max(error, std::abs(particles[strength][p] - bump(particles.positions()[p])));
  }
  std::printf("largest error after one turn: %.1e\n", error);
  return error < 1e-3 ? 0 : 1;
}
