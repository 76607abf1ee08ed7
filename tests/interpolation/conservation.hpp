// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/test/unit_test.hpp>

#include "interpolation/adjointness.hpp"

/// Powers up to the kernel's moments of the coordinate along an axis, scaled to [-1, 1] in the box.
template <class K, int D>
std::array<double, K::moments + 1> powers(const cambium::Lattice<D>& lattice, int axis, double x) {
  const auto& box = lattice.box();
  const double scaled = (x - box.centre()[axis]) / (0.5 * box.extent()[axis]);
  std::array<double, K::moments + 1> power{1.0};
  for (std::size_t a = 1; a < power.size(); ++a) power[a] = power[a - 1] * scaled;
  return power;
}

/// Adds strength x^alpha to all moments, alpha_d = 0, ..., K::moments for each axis.
template <class K, int D>
void add_moments(const cambium::Lattice<D>& lattice, const cambium::Vec<D>& x, double strength,
                 std::vector<double>& moments) {
  std::array<std::array<double, K::moments + 1>, 3> power{};
  for (int d = 0; d < 3; ++d)
    power[d] = d < D ? powers<K>(lattice, d, x[d]) : decltype(powers<K>(lattice, 0, 0.0)){1.0};
  std::size_t m = 0;
  for (std::size_t k = 0; k < (D > 2 ? power[2].size() : 1); ++k) {
    for (std::size_t j = 0; j < (D > 1 ? power[1].size() : 1); ++j) {
      for (std::size_t i = 0; i < power[0].size(); ++i)
        moments[m++] += strength * power[0][i] * power[1][j] * power[2][k];
    }
  }
}

/// sum_i q_i x_i^alpha = sum_p q_p x_p^alpha for every alpha up to the kernel's moments along each axis; on periodic
/// lattices, where powers of x mean nothing, the total. Relative to the sum of |q W|, which is what is added up: near
/// bounded faces extrapolation makes it larger than the sum of |q|.
template <class K, class S, int D>
void check_conservation(bool periodic) {
  cambium::Index<D> nodes;
  for (int d = 0; d < D; ++d) nodes[d] = std::max(K::support, K::moments + 1) + 2 * d + 1;
  const auto lattice = support::lattice_of<D>(nodes, periodic ? 7 : 0);
  const std::size_t count = 200;
  const auto x = support::random_positions<D>(lattice, count, 8);
  const auto strength = support::random_table<1, double>(count, -0.5, 1.0, 9);
  cambium::Field<double, D, S> mesh(lattice);
  cambium::Interpolator<K>().p2m(x.read(), strength.read(), mesh, cambium::Serial{});

  std::vector<double> before(static_cast<std::size_t>(std::pow(K::moments + 1, D) + 0.5), 0.0);
  auto after = before;
  for (std::size_t p = 0; p < count; ++p) {
    add_moments<K, D>(lattice, x.read()[p], strength.array[0][p], before);
  }
  support::for_each_lattice_node(lattice, [&](const cambium::Index<D>& node) {
    add_moments<K, D>(lattice, lattice.position(node), std::as_const(mesh)(node), after);
  });
  const double size = absolute_sum<K>(lattice, x, strength);
  for (std::size_t m = 0; m < (periodic ? 1 : before.size()); ++m) {
    BOOST_TEST(std::abs(after[m] - before[m]) <= 1e-12 * size, "D = " << D << ", support " << K::support << ", moment "
                                                                      << m << ": " << before[m] << " became "
                                                                      << after[m]);
  }
}
