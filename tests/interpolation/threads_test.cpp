// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE interpolation_threads
#include <boost/test/unit_test.hpp>

#include <cambium/interpolation.hpp>

#include "support/scattered.hpp"

using namespace cambium;

namespace {

/// Enough particles for several pieces of every loop; sorted by rows of nodes, or not.
template <int D>
Particles<D> some_particles(const Lattice<D>& lattice, bool sorted) {
  const std::size_t count = lattice.size();
  auto x = support::random_positions<D>(lattice, count, 1);
  if (sorted) {  // near the nodes in their order, without crossing a face of a cell
    const auto offset = support::random_table<D, double>(count, 0.01, 0.99, 2);
    for (std::size_t p = 0; p < count; ++p) {
      auto at = lattice.position(lattice.node(p));
      for (int d = 0; d < D; ++d) {
        const bool last = !lattice.periodic(d) && lattice.node(p)[d] == lattice.nodes()[d] - 1;
        at[d] += (last ? -1.0 : 1.0) * lattice.spacing() * offset.array[d][p];
      }
      x.write().set(p, at);
    }
  }
  Particles<D> particles(count);
  const auto mass = particles.template add<double>("mass");
  const auto pair = particles.template add<Vec<2>>("pair");
  const auto q = support::random_table<3, double>(count, -1.0, 1.0, 3);
  for (std::size_t p = 0; p < count; ++p) {
    particles.positions().set(p, x.read()[p]);
    particles[mass][p] = q.array[0][p];
    particles[pair].set(p, {q.array[1][p], q.array[2][p]});
  }
  return particles;
}

using Bits = std::vector<double>;

template <class V, int D, class S>
void append(const Field<V, D, S>& mesh, Bits& bits) {
  support::for_each_lattice_node(mesh.lattice(), [&](const Index<D>& node) {
    for (int c = 0; c < Components<V>::count; ++c) bits.push_back(component(mesh(node), c));
  });
}
template <int D>
void append(Particles<D>& particles, Bits& bits) {
  particles.for_each_array([&](const auto& array) { bits.insert(bits.end(), array.begin(), array.end()); });
}

/// Everything that interpolation on one kind of mesh gives.
template <class S, int D, class E>
Bits interpolated(const Lattice<D>& lattice, Particles<D> particles, const E& execution) {
  const auto mass = particles.template attribute<double>("mass");
  Bits bits;
  Interpolator<M4Prime> interpolate;
  Field<double, D, S> scalars(lattice);
  interpolate.p2m(particles, mass, scalars, execution);
  append(scalars, bits);
  interpolate.m2p(scalars, particles, mass, execution);
  append(particles, bits);
  const auto coverage = interpolate.p2m_renormalised(particles, mass, scalars, {}, execution);
  append(scalars, bits);
  bits.push_back(static_cast<double>(coverage.uncovered));
  bits.push_back(coverage.smallest_weight);
  return bits;
}

template <class Strategy, int D, class E>
Bits remeshed(const Lattice<D>& lattice, Particles<D> particles, const E& execution) {
  const auto mass = particles.template attribute<double>("mass");
  const auto pair = particles.template attribute<Vec<2>>("pair");
  RemeshParams params;
  if constexpr (std::is_same_v<Strategy, Tensor>) params.threshold = 0.3;
  Bits bits;
  const auto report = Remesher<M4Prime, Strategy, E>(params, execution)(particles, lattice, mass, pair);
  append(particles, bits);
  bits.push_back(static_cast<double>(report.created));
  bits.push_back(std::get<0>(report.dropped));
  bits.push_back(std::get<1>(report.dropped)[1]);
  return bits;
}

/// f(execution) gives the same bits for Serial and 1, ..., 4 threads.
template <class F>
void check_same_bits(F&& f) {
  const Bits serial = f(Serial{});
  for (int threads = 1; threads <= 4; ++threads) BOOST_TEST((f(OpenMP{threads}) == serial), threads << " threads");
}

template <int D>
Lattice<D> some_lattice(unsigned periodic) {
  const Index<3> nodes = D == 1 ? Index<3>{70001, 1, 1} : D == 2 ? Index<3>{203, 401, 1} : Index<3>{37, 34, 71};
  Index<D> those;
  for (int d = 0; d < D; ++d) those[d] = nodes[d];
  return support::lattice_of<D>(those, periodic);
}

}  // namespace

using Dimensions =
    std::tuple<std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

BOOST_AUTO_TEST_CASE_TEMPLATE(interpolation_gives_the_same_bits, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  for (const unsigned periodic : {0u, 7u}) {
    const auto lattice = some_lattice<D>(periodic);
    for (const bool sorted : {true, false}) {
      const auto particles = some_particles<D>(lattice, sorted);
      check_same_bits([&](const auto& execution) { return interpolated<Dense>(lattice, particles, execution); });
      check_same_bits([&](const auto& execution) { return interpolated<Sparse>(lattice, particles, execution); });
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(remeshing_gives_the_same_bits, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  for (const unsigned periodic : {0u, 7u}) {
    const auto lattice = some_lattice<D>(periodic);
    for (const bool sorted : {true, false}) {
      const auto particles = some_particles<D>(lattice, sorted);
      check_same_bits([&](const auto& execution) { return remeshed<Tensor>(lattice, particles, execution); });
    }
    auto moved = some_particles<D>(lattice, false);  // strengths; positions near their nodes
    for (std::size_t p = 0; p < lattice.size(); ++p) {
      auto at = lattice.position(lattice.node(p));
      for (int d = 0; d < D; ++d) {
        const double way = 0.3 * lattice.spacing() * std::sin(static_cast<double>(p + d));
        if (lattice.periodic(d) || (at[d] + way >= lattice.box().lo[d] && at[d] + way <= lattice.box().hi[d])) {
          at[d] += way;
        }
      }
      moved.positions().set(p, at);
    }
    check_same_bits([&](const auto& execution) { return remeshed<Split>(lattice, moved, execution); });
  }
}
