// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

// A user's program with a kernel of its own: a plain struct, no base class, no registration.
#include <cmath>
#include <cstdio>
#include <utility>

#include <cambium/core.hpp>
#include <cambium/interpolation/plain.hpp>
#include <cambium/parallel.hpp>
#include <cambium/particles/particles.hpp>

namespace {

/// Four-point Lagrange interpolation: the cubic through the four nodes around x.
struct Cubic {
  static constexpr int support = 4;
  static constexpr int moments = 3;
  static constexpr int degree = 3;
  static constexpr bool interpolating = true;

  template <class T>
  static constexpr T value(T x) {
    if (x < T(0)) x = -x;
    if (x < T(1)) return (T(1) - x) * (T(1) + x) * (T(2) - x) / T(2);
    return x < T(2) ? (T(1) - x) * (T(2) - x) * (T(3) - x) / T(6) : T(0);
  }
};

}  // namespace

int main() {
  cambium::check_remeshing_kernel<Cubic>();
  const auto box = cambium::Box<2>::cube();
  const auto lattice = cambium::Lattice<2>::bounded_box(box, 8);

  // Cubic reproduces cubic polynomials, up to the faces of a bounded box.
  const auto polynomial = [](const cambium::Vec<2>& x) { return 1.0 - x[0] * x[1] * x[1] + 2.0 * x[0] * x[0] * x[0]; };
  const auto field = cambium::sample(lattice, polynomial);

  cambium::Particles<2> particles(100);
  const auto value = particles.add<double>("value");
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const auto k = static_cast<double>(p);
    particles.positions().set(p, {std::fmod(0.618 * k, 1.0), std::fmod(0.414 * k, 1.0)});
  }
  cambium::plain::m2p<Cubic>(field, std::as_const(particles).positions(),
                             cambium::Columns<1, double>(particles[value]));

  double error = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    error = std::max(error, std::abs(particles[value][p] - polynomial(particles.positions()[p])));
  }
  std::printf("largest error of cubic interpolation of a cubic: %.1e\n", error);
  return error < 1e-13 ? 0 : 1;
}
