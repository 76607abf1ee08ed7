// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

// A user's program with a kernel of its own: a plain struct, no base class, no registration.
#include <cmath>
#include <cstdio>

#include <cambium/cambium.hpp>

#include "../own_policies/kernel.hpp"

namespace {

/// sum_p strength_p f(x_p)
template <class F>
double total(const cambium::Particles<2>& particles, cambium::Attribute<double> strength, F&& f) {
  double sum = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) sum += particles[strength][p] * f(particles.positions()[p]);
  return sum;
}

}  // namespace

int main() {
  const auto lattice = cambium::Lattice<2>::bounded_box(cambium::Box<2>::cube(), 8);
  cambium::Particles<2> particles(100);
  const auto strength = particles.add<double>("strength");
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const auto k = static_cast<double>(p);
    particles.positions().set(p, {std::fmod(0.618 * k, 1.0), std::fmod(0.414 * k, 1.0)});
    particles[strength][p] = std::cos(k);
  }

  // A kernel with moments up to 3 keeps sum_p strength_p f(x_p) for every f that is cubic along each axis.
  const auto cubic = [](const cambium::Vec<2>& x) { return 1.0 - x[0] * x[1] * x[1] + 2.0 * x[0] * x[0] * x[0]; };
  const double before = total(particles, strength, cubic);
  cambium::Remesher<Cubic> remesh;
  remesh(particles, lattice, strength);
  const double after = total(particles, strength, cubic);

  std::printf("%zu particles, moment %.15f before and %.15f after remeshing\n", particles.size(), before, after);
  return particles.size() == lattice.size() && std::abs(after - before) < 1e-12 ? 0 : 1;
}
