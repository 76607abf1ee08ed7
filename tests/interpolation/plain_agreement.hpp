// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include <cambium/interpolation.hpp>

#include "support/scattered.hpp"

/// Particles in every awkward place: on nodes, on the faces of cells of both parities, on the bounded upper face, in
/// other periods, many in one cell, and at random (the first places stay empty of them).
template <int D>
support::Table<D, double> awkward_positions(const cambium::Lattice<D>& lattice, std::size_t scattered) {
  auto x = support::random_positions<D, double>(lattice, scattered, 3, 0.35, 1.0);
  const auto add = [&](const cambium::Vec<D>& at) {
    for (int d = 0; d < D; ++d) x.array[d].push_back(at[d]);
  };
  const cambium::Index<D>& n = lattice.nodes();
  for (std::ptrdiff_t k = 0; k < 12; ++k) {
    cambium::Index<D> node;
    for (int d = 0; d < D; ++d) node[d] = (k * (2 * d + 1) + 3 * n[d] - 3) % n[d];
    cambium::Vec<D> at = lattice.position(node);
    add(at);  // a node, also those on the faces
    for (int d = 0; d < D; ++d) {
      if (lattice.periodic(d) || node[d] + 1 < n[d]) at[d] += (k % 2 == 0 ? 0.5 : 0.25) * lattice.spacing();
    }
    add(at);                                                                                           // between nodes
    add(lattice.position(cambium::Index<D>{}) + cambium::Vec<D>::constant(0.37 * lattice.spacing()));  // one cell
    for (int d = 0; d < D; ++d) {
      if (lattice.periodic(d)) at[d] += static_cast<double>(k - 6) * (lattice.box().hi[d] - lattice.box().lo[d]);
    }
    add(at);  // another period
  }
  add(lattice.box().lo);
  add(lattice.box().hi);
  return x;
}

/// Numbers of the particles in the order of cells or of rows of cells (axis 0 does not count).
template <class K, int D>
std::vector<std::size_t> sorted_order(const cambium::Lattice<D>& lattice, const support::Table<D, double>& x,
                                      bool by_cell) {
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t p) {
    std::array<std::ptrdiff_t, D> cell;
    for (int d = 0; d < D; ++d) {
      cell[D - 1 - d] = cambium::detail::AxisLocator<K, double>(lattice, d)(x.array[d][p]).cell;
    }
    if (!by_cell) cell[D - 1] = 0;
    return std::pair(cell, p);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

template <int C>
support::Table<C, double> permuted(const support::Table<C, double>& table, const std::vector<std::size_t>& order) {
  support::Table<C, double> result(order.size());
  for (int c = 0; c < C; ++c) {
    for (std::size_t p = 0; p < order.size(); ++p) result.array[c][p] = table.array[c][order[p]];
  }
  return result;
}

/// Largest sum of |W| over the stencil of a particle, closed faces included.
template <class K, int D>
double largest_weight_sum(const cambium::Lattice<D>& lattice, const support::Table<D, double>& x) {
  double largest = 0.0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    double weight = 1.0;
    for (int d = 0; d < D; ++d) {
      const cambium::plain::AxisStencil<K> axis(lattice, d, x.array[d][p]);
      double along = 0.0;
      for (int k = 0; k < axis.count; ++k) along += std::abs(axis.weight[k]);
      weight *= along;
    }
    largest = std::max(largest, weight);
  }
  return largest;
}

/// Holds p2m and m2p against the plain loops for one set of particles in one order.
///
/// An offset is known to eps times the position in spacings (up to 6 periods of n nodes), and |W'| sums to less than 8;
/// at most 16 particles give weight to a node.
template <class K, class S, int D>
void check_plain_agreement(const cambium::Lattice<D>& lattice, const support::Table<D, double>& x,
                           const cambium::Field<double, D>& spread_plainly, const support::Table<1, double>& strength,
                           const cambium::Field<double, D>& values, const support::Table<1, double>& read_plainly,
                           double weight_sum) {
  cambium::Field<double, D, S> spread(lattice), mesh(lattice);
  support::for_each_lattice_node(lattice, [&](const cambium::Index<D>& node) {
    if constexpr (std::is_same_v<S, cambium::Sparse>) {
      mesh.set(node, values(node));
    } else {
      mesh(node) = values(node);
    }
  });
  const auto most_nodes =
      static_cast<double>(*std::max_element(lattice.nodes().component, lattice.nodes().component + D));
  const double tolerance = 16.0 * (D * 8.0 * 6.0 * most_nodes) * std::numeric_limits<double>::epsilon() * weight_sum;
  cambium::Interpolator<K> interpolate;
  for (int repetition = 0; repetition < 2; ++repetition) {  // the second time with used buffers
    interpolate.p2m(x.read(), strength.read(), spread, cambium::Serial{});
    double error = 0.0;
    support::for_each_lattice_node(lattice, [&](const cambium::Index<D>& node) {
      error = std::max(error, std::abs(std::as_const(spread)(node) - spread_plainly(node)));
    });
    BOOST_TEST(error <= tolerance, "p2m, D = " << D << ", nodes " << lattice.nodes() << ", support " << K::support
                                               << ": differs by " << error << ", tolerance " << tolerance);
    support::Table<1, double> read(x.size(), -7.0);
    interpolate.m2p(mesh, x.read(), read.write(), cambium::Serial{});
    error = 0.0;
    for (std::size_t p = 0; p < x.size(); ++p) {
      error = std::max(error, std::abs(read.array[0][p] - read_plainly.array[0][p]));
    }
    BOOST_TEST(error <= tolerance, "m2p, D = " << D << ", nodes " << lattice.nodes() << ", support " << K::support
                                               << ": differs by " << error << ", tolerance " << tolerance);
  }
}

/// Particles unsorted, in the order of rows and in the order of cells.
template <class K, int D>
void check_plain_agreement(const cambium::Lattice<D>& lattice, std::size_t scattered) {
  const auto original = awkward_positions(lattice, scattered);
  const auto strength = support::random_table<1, double>(original.size(), -1.0, 1.0, 4);
  cambium::Field<double, D> values(lattice), spread(lattice);
  const auto random = support::random_table<1, double>(lattice.size(), -1.0, 1.0, 6);
  std::copy(random.array[0].begin(), random.array[0].end(), values.data());
  support::Table<1, double> read(original.size());
  cambium::plain::p2m<K>(original.read(), strength.read(), spread);
  cambium::plain::m2p<K>(values, original.read(), read.write());
  const double weight_sum = largest_weight_sum<K>(lattice, original);
  std::vector<std::size_t> order(original.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (const int sorting : {0, 1, 2}) {
    if (sorting > 0) order = sorted_order<K>(lattice, original, sorting == 2);
    const auto x = permuted(original, order);
    const auto q = permuted(strength, order);
    const auto expected = permuted(read, order);
    check_plain_agreement<K, cambium::Dense>(lattice, x, spread, q, values, expected, weight_sum);
    check_plain_agreement<K, cambium::Sparse>(lattice, x, spread, q, values, expected, weight_sum);
  }
}

/// The smallest lattice the kernel takes, and one of several slabs and blocks, periodic and bounded in every way.
template <class K, int D>
void check_plain_agreement() {
  constexpr int smallest = std::max(K::support, K::moments + 1);
  for (unsigned periodic = 0; periodic < 1u << D; ++periodic) {
    cambium::Index<D> nodes = cambium::Index<D>::constant(smallest);
    check_plain_agreement<K>(support::lattice_of<D>(nodes, periodic), 5);
    for (int d = 0; d < D; ++d) nodes[d] = smallest + 5 + 2 * d;
    nodes[D - 1] = 6 * K::support + 5;
    check_plain_agreement<K>(support::lattice_of<D>(nodes, periodic), D == 3 ? 30 : 200);
  }
}

/// No particles: the mesh is zero, and nothing is read.
template <class K, class S, int D>
void check_no_particles() {
  const auto lattice = support::lattice_of<D>(cambium::Index<D>::constant(K::support + 9), 1);
  cambium::Field<double, D, S> mesh(lattice, 0.0);
  mesh.fill(3.0);
  if constexpr (std::is_same_v<S, cambium::Sparse>) mesh.set(cambium::Index<D>{}, 3.0);
  support::Table<D, double> x(0);
  support::Table<1, double> q(0);
  cambium::Interpolator<K> interpolate;
  interpolate.m2p(mesh, x.read(), q.write(), cambium::Serial{});
  interpolate.p2m(x.read(), q.read(), mesh, cambium::Serial{});
  support::for_each_lattice_node(
      lattice, [&](const cambium::Index<D>& node) { BOOST_REQUIRE(std::as_const(mesh)(node) == 0.0); });
  if constexpr (std::is_same_v<S, cambium::Sparse>) BOOST_TEST(mesh.blocks() == 0u);
}
