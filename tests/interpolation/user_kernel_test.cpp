// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE user_kernel
#include <boost/test/unit_test.hpp>

#include <cambium/interpolation.hpp>
#include <cambium/kernels/m6.hpp>

#include "support/scattered.hpp"

using namespace cambium;

namespace {

/// M6 as a user would write it, value alone: everything goes through value(), no polynomials are known.
struct ByValue {
  static constexpr int support = 6;
  static constexpr int moments = 4;
  static constexpr double value(double x) {
    const double r = x < 0.0 ? -x : x;
    if (r < 1.0) return 1.0 + r * r * (-15.0 + r * (-35.0 + r * (63.0 - 25.0 * r))) / 12.0;
    if (r < 2.0) return (-96.0 + r * (450.0 + r * (-735.0 + r * (545.0 + r * (-189.0 + 25.0 * r))))) / 24.0;
    return r < 3.0 ? (432.0 + r * (-918.0 + r * (765.0 + r * (-313.0 + r * (63.0 - 5.0 * r))))) / 24.0 : 0.0;
  }
};

/// The same with the degree of its pieces, from which their polynomials are found.
struct ByDegree {
  static constexpr int support = 6;
  static constexpr int moments = 4;
  static constexpr int degree = 5;
  static constexpr double value(double x) { return ByValue::value(x); }
};

static_assert(!Taps<ByValue>::polynomial && Taps<ByDegree>::polynomial);

// Powers of |x| cancel: the terms reach 1e4, the values are good to 1e-12; strengths are of size 1, and at most some
// tens of particles meet in a node. Closed faces multiply by up to 1e2 along each axis.
constexpr double tolerance = 1e-8;

template <class K>
support::Table<1, double> spread_and_read(const Lattice<2>& lattice) {
  const auto x = support::random_positions<2>(lattice, 500, 1);
  const auto q = support::random_table<1, double>(500, -1.0, 1.0, 2);
  Interpolator<K> interpolate;
  Field<double, 2> dense(lattice);
  Field<double, 2, Sparse> sparse(lattice);
  interpolate.p2m(x.read(), q.read(), dense, Serial{});
  interpolate.p2m(x.read(), q.read(), sparse, Serial{});
  support::Table<1, double> result(2 * lattice.size()), read(500);
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    result.array[0][2 * i] = dense[i];
    result.array[0][2 * i + 1] = std::as_const(sparse)(lattice.node(i));
  }
  interpolate.m2p(dense, x.read(), read.write(), Serial{});
  result.array[0].insert(result.array[0].end(), read.array[0].begin(), read.array[0].end());
  interpolate.m2p(sparse, x.read(), read.write(), Serial{});
  result.array[0].insert(result.array[0].end(), read.array[0].begin(), read.array[0].end());
  return result;
}

template <class K, class Strategy>
support::Table<1, double> remesh(const Lattice<2>& lattice) {
  Particles<2> particles(lattice.size());
  const auto mass = particles.add<double>("mass");
  for (std::size_t p = 0; p < lattice.size(); ++p) {
    const Vec<2> node = lattice.position(lattice.node(p));
    const Vec<2> from_faces{(node[0] - lattice.box().lo[0]) * (lattice.box().hi[0] - node[0]),
                            (node[1] - lattice.box().lo[1]) * (lattice.box().hi[1] - node[1])};
    particles.positions().set(p, node + Vec<2>{0.3 * from_faces[0], -0.2 * from_faces[1]});
    particles[mass][p] = std::cos(5.0 * node[0] + 3.0 * node[1]);
  }
  Remesher<K, Strategy, Serial>()(particles, lattice, mass);
  support::Table<1, double> result(0);
  result.array[0].assign(particles[mass].begin(), particles[mass].end());
  return result;
}

double difference(const support::Table<1, double>& a, const support::Table<1, double>& b) {
  BOOST_REQUIRE(a.size() == b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double apart = std::abs(a.array[0][i] - b.array[0][i]);
    if (!(apart <= largest)) largest = apart;  // NaN, too
  }
  return largest;
}

}  // namespace

using UserKernels = std::tuple<ByValue, ByDegree>;

BOOST_AUTO_TEST_CASE_TEMPLATE(interpolation_agrees_with_m6, K, UserKernels) {
  for (const unsigned periodic : {3u, 0u, 1u}) {
    const auto lattice = support::lattice_of<2>({23, 41}, periodic);
    BOOST_TEST(difference(spread_and_read<K>(lattice), spread_and_read<M6>(lattice)) <= tolerance);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(remeshing_agrees_with_m6, K, UserKernels) {
  for (const unsigned periodic : {3u, 0u, 1u}) {
    const auto lattice = support::lattice_of<2>({23, 41}, periodic);
    BOOST_TEST(difference(remesh<K, Tensor>(lattice), remesh<M6, Tensor>(lattice)) <= tolerance);
    BOOST_TEST(difference(remesh<K, Split>(lattice), remesh<M6, Split>(lattice)) <= tolerance);
  }
}
