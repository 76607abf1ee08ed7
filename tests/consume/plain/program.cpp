// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

// A user's program without CMake, which links everything that the library may ask for: FFTW in both precisions, OpenMP.
#include <cmath>
#include <cstdio>
#include <numbers>

#include <cambium/cambium.hpp>

namespace {

/// Largest error of -Lap u = sin x cos y, u = sin x cos y / 2, by transforms in the precision T.
template <class T>
double error_of_solution() {
  const auto lattice = cambium::Lattice<2>::periodic_box(cambium::Box<2>::cube(2.0 * std::numbers::pi), 16);
  cambium::Field<T, 2> f(lattice);
  cambium::Field<T, 2> u(lattice);
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const auto x = lattice.position(lattice.node(i));
    f[i] = static_cast<T>(std::sin(x[0]) * std::cos(x[1]));
  }
  cambium::PeriodicPoisson<2, cambium::Spectral, T>(lattice).solve(f, u);
  double error = 0.0;
  for (std::size_t i = 0; i < lattice.size(); ++i) error = std::max(error, std::abs(double(u[i]) - 0.5 * double(f[i])));
  return error;
}

}  // namespace

int main() {
  const double single = error_of_solution<float>();
  const double twice = error_of_solution<double>();
  std::printf("cambium %d.%d.%d: errors %.1e and %.1e\n", CAMBIUM_VERSION_MAJOR, CAMBIUM_VERSION_MINOR,
              CAMBIUM_VERSION_PATCH, single, twice);
  return single < 1e-6 && twice < 1e-14 ? 0 : 1;  // a few units of round-off
}
