// expect: cambium: particles and mesh must have the same number of components
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/interpolation/p2m.hpp>
#include <cambium/kernels/m4_prime.hpp>

#ifdef CAMBIUM_CONTROL
using Value = double;
#else
using Value = cambium::Vec<3>;
#endif

int main() {
  const auto lattice = cambium::Lattice<2>::periodic_box(cambium::Box<2>::cube(), 8);
  cambium::Particles<2> particles(5);
  const auto mass = particles.add<double>("mass");
  cambium::Field<Value, 2> mesh(lattice);
  cambium::p2m<cambium::M4Prime>(particles, mass, mesh);
}
