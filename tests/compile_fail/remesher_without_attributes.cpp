// expect: cambium::Remesher: name the attributes to be remeshed
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/interpolation/remesher.hpp>
#include <cambium/kernels/m4_prime.hpp>

int main() {
  const auto lattice = cambium::Lattice<2>::periodic_box(cambium::Box<2>::cube(), 8);
  cambium::Particles<2> particles(5);
  const auto mass = particles.add<double>("mass");
  cambium::Remesher<cambium::M4Prime> remesh;
#ifdef CAMBIUM_CONTROL
  remesh(particles, lattice, mass);
#else
  remesh(particles, lattice);
  (void)mass;
#endif
}
