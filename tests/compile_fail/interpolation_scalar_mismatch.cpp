// expect: cambium: particles and mesh must hold the same scalar type
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/interpolation/m2p.hpp>
#include <cambium/kernels/m4_prime.hpp>

#ifdef CAMBIUM_CONTROL
using Scalar = double;
#else
using Scalar = float;
#endif

int main() {
  const auto lattice = cambium::Lattice<2>::periodic_box(cambium::Box<2>::cube(), 8);
  cambium::Particles<2> particles(5);
  const auto mass = particles.add<double>("mass");
  const cambium::Field<Scalar, 2> mesh(lattice);
  cambium::m2p<cambium::M4Prime>(mesh, particles, mass);
}
