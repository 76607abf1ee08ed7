// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/test/unit_test.hpp>
#include <limits>

#include <cambium/interpolation.hpp>

#include "support/scattered.hpp"

/// sum_p |a_p| sum_i |W(x_i - x_p)| for |b| <= 1: the size of what is summed, closed faces included.
template <class K, int D, class P, int C, class T>
double absolute_sum(const cambium::Lattice<D>& lattice, const support::Table<D, P>& x, const support::Table<C, T>& a) {
  double sum = 0.0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    double weight = 1.0;
    for (int d = 0; d < D; ++d) {
      const cambium::plain::AxisStencil<K> axis(lattice, d, static_cast<double>(x.array[d][p]));
      double along = 0.0;
      for (int k = 0; k < axis.count; ++k) along += std::abs(axis.weight[k]);
      weight *= along;
    }
    for (int c = 0; c < C; ++c) sum += weight * std::abs(static_cast<double>(a.array[c][p]));
  }
  return sum;
}

/// A mesh of random values; if it is sparse, every third block stays inactive.
template <int C, class T, int D>
void randomise(cambium::Field<support::ValueOf<C, T>, D, cambium::Dense>& mesh) {
  const auto random = support::random_table<C, T>(mesh.size(), -1.0, 1.0, 5);
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    for (int c = 0; c < C; ++c) cambium::component(mesh[i], c) = random.array[c][i];
  }
}
template <int C, class T, int D>
void randomise(cambium::Field<support::ValueOf<C, T>, D, cambium::Sparse>& mesh) {
  const auto random = support::random_table<C, T>(mesh.lattice().size(), -1.0, 1.0, 5);
  std::size_t i = 0;
  support::for_each_lattice_node(mesh.lattice(), [&](const cambium::Index<D>& node) {
    const auto block = mesh.block_of(node);
    std::ptrdiff_t number = 0;
    for (int d = 0; d < D; ++d) number += block[d];
    support::ValueOf<C, T> value{};
    for (int c = 0; c < C; ++c) cambium::component(value, c) = random.array[c][i];
    ++i;
    if (number % 3 != 2) mesh.set(node, value);
  });
}

/// <p2m a, b> = <a, m2p b> for random particles in the upper part of the box (so that a sparse mesh has gaps).
///
/// Each product a_p W b_i goes through D + 3 roundings; the sums over the nodes of a stencil, support^D terms, add
/// round-off like the square root of their number, at most support^(D/2) <= 4 support.
template <class K, class T, int D, int C, class S>
void check_adjointness(const cambium::Lattice<D>& lattice) {
  const std::size_t count = 400;
  const auto x = support::random_positions<D, T>(lattice, count, 1, 0.3, 1.0);
  const auto a = support::random_table<C, T>(count, -1.0, 1.0, 2);
  cambium::Field<support::ValueOf<C, T>, D, S> spread(lattice), b(lattice);
  randomise<C, T, D>(b);
  support::Table<C, T> read(count);
  cambium::Interpolator<K> interpolate;
  interpolate.p2m(x.read(), a.read(), spread, cambium::Serial{});
  interpolate.m2p(b, x.read(), read.write(), cambium::Serial{});

  double on_mesh = 0.0, on_particles = 0.0;
  support::for_each_lattice_node(lattice, [&](const cambium::Index<D>& node) {
    const auto& left = std::as_const(spread)(node);
    const auto& right = std::as_const(b)(node);
    for (int c = 0; c < C; ++c) {
      on_mesh += static_cast<double>(cambium::component(left, c)) * static_cast<double>(cambium::component(right, c));
    }
  });
  for (int c = 0; c < C; ++c) {
    for (std::size_t p = 0; p < count; ++p) {
      on_particles += static_cast<double>(a.array[c][p]) * static_cast<double>(read.array[c][p]);
    }
  }
  const double size = absolute_sum<K>(lattice, x, a);
  const double tolerance = (D + 3 + 4 * K::support) * static_cast<double>(std::numeric_limits<T>::epsilon()) * size;
  BOOST_TEST(std::abs(on_mesh - on_particles) <= tolerance,
             "D = " << D << ", C = " << C << ", support " << K::support << ", moments " << K::moments << ", periodic "
                    << lattice.periodic(0) << lattice.periodic(D - 1) << ": <p2m a, b> = " << on_mesh
                    << ", <a, m2p b> = " << on_particles << ", tolerance " << tolerance);
  // The scalar product is not zero by chance.
  BOOST_TEST(std::abs(on_particles) > (std::is_same_v<T, float> ? 10.0 : 1e4) * tolerance);
}

/// All combinations of periodic and bounded axes. The last axis is long enough for several slabs.
template <class K, class T, int D, int C, class S>
void check_adjointness() {
  for (unsigned periodic = 0; periodic < 1u << D; ++periodic) {
    cambium::Index<D> nodes;
    for (int d = 0; d < D; ++d) nodes[d] = K::support + 3 + 2 * d;
    nodes[D - 1] = 6 * K::support + 7;
    check_adjointness<K, T, D, C, S>(support::lattice_of<D>(nodes, periodic));
  }
}
