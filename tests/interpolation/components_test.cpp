// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE interpolation_components
#include <boost/test/unit_test.hpp>

#include "interpolation/adjointness.hpp"

using namespace cambium;

namespace {

/// Components of one mesh are what scalar meshes hold, and float is double to its own precision.
template <class K, class T, int D, int C, class S>
void check_components(unsigned periodic) {
  Index<D> nodes;
  for (int d = 0; d < D; ++d) nodes[d] = K::support + 9 + 4 * d;
  const auto lattice = support::lattice_of<D>(nodes, periodic);
  const std::size_t count = 300;
  const auto x = support::random_positions<D, T>(lattice, count, 1);
  const auto q = support::random_table<C, T>(count, -1.0, 1.0, 2);
  support::Table<D, double> x_double(count);
  for (int d = 0; d < D; ++d) std::copy(x.array[d].begin(), x.array[d].end(), x_double.array[d].begin());
  Field<support::ValueOf<C, T>, D, S> mesh(lattice);
  Interpolator<K> interpolate;
  interpolate.p2m(x.read(), q.read(), mesh, Serial{});
  support::Table<C, T> read(count);
  interpolate.m2p(mesh, x.read(), read.write(), Serial{});
  const support::Table<1, T> ones(count, T(1));
  // As in the comparison with plain loops: offsets are known to eps times 3 periods of 50 nodes at most, |W'| < 8;
  // sums reach 16 particles each way.
  const double weights = absolute_sum<K>(lattice, x, ones) / static_cast<double>(count);
  const double tolerance = 16.0 * 16.0 * D * 8.0 * 150.0 * std::numeric_limits<T>::epsilon() * weights * weights;
  for (int c = 0; c < C; ++c) {
    support::Table<1, double> component_c(count), read_c(count);
    std::copy(q.array[c].begin(), q.array[c].end(), component_c.array[0].begin());
    Field<double, D> plain(lattice);
    plain::p2m<K>(x_double.read(), component_c.read(), plain);
    plain::m2p<K>(plain, x_double.read(), read_c.write());
    double error = 0.0;
    support::for_each_lattice_node(lattice, [&](const Index<D>& node) {
      error = std::max(error, std::abs(double{component(std::as_const(mesh)(node), c)} - plain(node)));
    });
    for (std::size_t p = 0; p < count; ++p) {
      error = std::max(error, std::abs(double{read.array[c][p]} - read_c.array[0][p]));
    }
    BOOST_TEST(error <= tolerance, "component " << c << " of " << C << ", D = " << D << ", support " << K::support
                                                << ": " << error << " > " << tolerance);
  }
}

template <class K, class T, int D, int C>
void check_both_storages() {
  check_adjointness<K, T, D, C, Dense>();
  check_adjointness<K, T, D, C, Sparse>();
  for (const unsigned periodic : {0u, 2u, 7u}) {
    check_components<K, T, D, C, Dense>(periodic);
    check_components<K, T, D, C, Sparse>(periodic);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(in_one_dimension) {
  check_both_storages<M3, float, 1, 3>();
  check_both_storages<M6, double, 1, 2>();
}
BOOST_AUTO_TEST_CASE(in_two_dimensions) {
  check_both_storages<M4Prime, double, 2, 3>();
  check_both_storages<M3, double, 2, 2>();
  check_both_storages<M6, float, 2, 1>();
}
BOOST_AUTO_TEST_CASE(in_three_dimensions) {
  check_both_storages<M4Prime, float, 3, 2>();
  check_both_storages<M6, double, 3, 3>();
  check_both_storages<Hat, float, 3, 1>();
}
