// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

// Figures that vectors of every width must agree on to round-off: one a line, `name value scale`.
#include <cmath>
#include <cstdio>

#include <cambium/interpolation.hpp>
#include <cambium/kernels.hpp>
#include <cambium/levelset/closest_point.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/measures.hpp>

namespace {

using namespace cambium;

void print(const char* name, double value, double scale) { std::printf("%s %.17g %.17g\n", name, value, scale); }

/// What particles at random leave on a lattice, and read back.
void interpolation() {
  const auto lattice = Lattice<3>::periodic_box(Box<3>::cube(), 12);
  Particles<3> particles(500);
  const auto strength = particles.add<double>("strength");
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const auto k = static_cast<double>(p);
    particles.positions().set(p, {std::fmod(0.618 * k, 1.0), std::fmod(0.414 * k, 1.0), std::fmod(0.732 * k, 1.0)});
    particles[strength][p] = std::cos(k);
  }
  Field<double, 3> mesh(lattice);
  p2m<M6>(particles, strength, mesh);
  for (const std::size_t node : {0u, 5u, 77u, 100u, 1500u}) print("mesh", mesh[node], 1.0);
  m2p<M6>(mesh, particles, strength);
  for (const std::size_t p : {0u, 1u, 250u, 499u}) print("particles", particles[strength][p], 1.0);
}

/// A ball that is made a distance and measured.
void interface() {
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 32);
  const Vec<2> centre{0.5, 0.6};
  LevelSet<ClosestPoint, 2> ball(lattice, [&](const Vec<2>& x) { return dot(x - centre, x - centre) - 0.04; });
  const Measures<2> whole = measures(ball.band());
  print("volume", whole.volume, whole.volume);
  print("area", whole.area, whole.area);
  print("curvature", whole.greatest_curvature, 5.0 * 32.0 * 32.0);  // two differences magnify round-off by 1 / h^2
}

}  // namespace

int main() {
  interpolation();
  interface();
}
