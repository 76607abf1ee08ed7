// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE remesher
#include <boost/test/unit_test.hpp>

#include <cambium/interpolation.hpp>
#include <cambium/particles/totals.hpp>

#include "support/scattered.hpp"

using namespace cambium;

namespace {

/// Scattered particles with a scalar, a vector and an attribute that is not remeshed.
template <int D>
struct Scene {
  Lattice<D> lattice;
  Particles<D> particles{500};
  Attribute<double> mass = particles.template add<double>("mass");
  Attribute<double> age = particles.template add<double>("age", 4.0);
  Attribute<Vec<2>> momentum = particles.template add<Vec<2>>("momentum");

  explicit Scene(const Lattice<D>& on) : lattice(on) {
    const auto x = support::random_positions<D>(lattice, particles.size(), 1, 0.3, 0.8);
    const auto q = support::random_table<3, double>(particles.size(), -0.5, 1.0, 2);
    for (std::size_t p = 0; p < particles.size(); ++p) {
      particles.positions().set(p, x.read()[p]);
      particles[mass][p] = q.array[0][p];
      particles[momentum].set(p, {q.array[1][p], q.array[2][p]});
      particles[age][p] = 9.0;
    }
  }
};

template <int D>
Lattice<D> some_lattice(unsigned periodic) {
  Index<D> nodes;
  for (int d = 0; d < D; ++d) nodes[d] = 17 + 3 * d;
  return support::lattice_of<D>(nodes, periodic);
}

}  // namespace

using Dimensions =
    std::tuple<std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

BOOST_AUTO_TEST_CASE_TEMPLATE(every_node_gets_its_particle, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  for (const unsigned periodic : {0u, 7u}) {
    Scene<D> scene(some_lattice<D>(periodic));
    Field<double, D> mass(scene.lattice);
    Field<Vec<2>, D> momentum(scene.lattice);
    p2m<M4Prime>(scene.particles, scene.mass, mass);
    p2m<M4Prime>(scene.particles, scene.momentum, momentum);
    const auto report = Remesher<M4Prime>()(scene.particles, scene.lattice, scene.momentum, scene.mass);
    BOOST_TEST(report.created == scene.lattice.size());
    BOOST_TEST(report.dropped_nodes == 0u);
    BOOST_TEST((report.dropped == std::tuple<Vec<2>, double>{}));
    BOOST_REQUIRE(scene.particles.size() == scene.lattice.size());
    for (std::size_t i = 0; i < scene.lattice.size(); ++i) {
      BOOST_REQUIRE(scene.particles.positions()[i] == scene.lattice.position(scene.lattice.node(i)));
      BOOST_REQUIRE(scene.particles[scene.mass][i] == mass[i]);
      BOOST_REQUIRE(scene.particles[scene.momentum][i] == momentum[i]);
      BOOST_REQUIRE(scene.particles[scene.age][i] == 4.0);  // anew from the initial value
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_is_dropped_is_accounted_for, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  for (const double threshold : {1e-12, 0.05, 0.5, 1e9}) {
    Scene<D> scene(some_lattice<D>(0));
    const double mass = total(std::as_const(scene.particles)[scene.mass]);
    const Vec<2> momentum = total(std::as_const(scene.particles)[scene.momentum]);
    Field<double, D> mesh(scene.lattice);
    Field<Vec<2>, D> vectors(scene.lattice);
    p2m<M4Prime>(scene.particles, scene.mass, mesh);
    p2m<M4Prime>(scene.particles, scene.momentum, vectors);
    const auto report =
        Remesher<M4Prime>({.threshold = threshold})(scene.particles, scene.lattice, scene.mass, scene.momentum);

    std::size_t p = 0;  // the nodes that reach the threshold in any component, in the order of the lattice
    for (std::size_t i = 0; i < scene.lattice.size(); ++i) {
      if (std::max({std::abs(mesh[i]), std::abs(vectors[i][0]), std::abs(vectors[i][1])}) < threshold) continue;
      BOOST_REQUIRE(p < scene.particles.size());
      BOOST_REQUIRE(scene.particles.positions()[p] == scene.lattice.position(scene.lattice.node(i)));
      BOOST_REQUIRE(scene.particles[scene.mass][p] == mesh[i]);
      BOOST_REQUIRE(scene.particles[scene.momentum][p] == vectors[i]);
      ++p;
    }
    BOOST_TEST(scene.particles.size() == p);
    BOOST_TEST(report.created == p);
    BOOST_TEST(report.created + report.dropped_nodes == scene.lattice.size());
    BOOST_TEST((threshold > 1.0 ? report.created == 0 : report.dropped_nodes > 0));
    // 500 strengths of size 1, each through some tens of roundings.
    const double tolerance = 500.0 * 64.0 * 2.2e-16;
    const double mass_after = total(std::as_const(scene.particles)[scene.mass]) + std::get<0>(report.dropped);
    BOOST_TEST(std::abs(mass_after - mass) <= tolerance);
    const Vec<2> lost = total(std::as_const(scene.particles)[scene.momentum]) + std::get<1>(report.dropped) - momentum;
    BOOST_TEST(norm(lost) <= tolerance);
  }
}

BOOST_AUTO_TEST_CASE(buffers_follow_the_lattice_and_the_number_of_particles) {
  Remesher<M4Prime> remesh({.threshold = 1e-3});
  for (const unsigned periodic : {0u, 3u, 1u, 0u}) {
    Scene<2> reused(some_lattice<2>(periodic)), fresh(some_lattice<2>(periodic));
    for (int repetition = 0; repetition < 2; ++repetition) {
      remesh(reused.particles, reused.lattice, reused.mass);
      Remesher<M4Prime>({.threshold = 1e-3})(fresh.particles, fresh.lattice, fresh.mass);
      BOOST_REQUIRE(reused.particles.size() == fresh.particles.size());
      for (std::size_t p = 0; p < fresh.particles.size(); ++p) {
        BOOST_REQUIRE(reused.particles.positions()[p] == fresh.particles.positions()[p]);
        BOOST_REQUIRE(reused.particles[reused.mass][p] == fresh.particles[fresh.mass][p]);
        BOOST_REQUIRE(reused.particles[reused.momentum][p] == Vec<2>());
      }
    }
  }
}

namespace {

/// Remeshes particles of a lattice three times with the given strategy, and interpolates them to a mesh.
template <class P, class Strategy, class S>
void remesh_again(const Lattice<2>& lattice) {
  Particles<2, P> particles(lattice.size());
  const auto mass = particles.template add<P>("mass", P(1));
  for (std::size_t p = 0; p < lattice.size(); ++p) {
    const auto x = lattice.position(lattice.node(p));
    particles.positions().set(p, {static_cast<P>(x[0]), static_cast<P>(x[1])});
  }
  Field<P, 2, S> mesh(lattice);
  for (int repetition = 0; repetition < 3; ++repetition) {
    Remesher<M4Prime, Strategy>()(particles, lattice, mass);
    p2m<M4Prime>(particles, mass, mesh);
  }
}

}  // namespace

// New particles on the faces must count as inside the box, whatever lo + n h rounds to, in float as in double.
BOOST_AUTO_TEST_CASE(particles_on_the_faces_of_a_bounded_box_are_inside) {
  for (std::ptrdiff_t cells = 4; cells < 60; cells += 3) {
    for (const double hi : {0.3, 0.7, 1.0, 1.1, 2.3}) {
      const auto lattice = Lattice<2>::bounded_box({{-0.1, 0.2 + 0.1}, {hi, 0.3 + hi + 0.1}}, cells);
      BOOST_CHECK_NO_THROW((remesh_again<double, Tensor, Dense>(lattice)));
      BOOST_CHECK_NO_THROW((remesh_again<double, Split, Sparse>(lattice)));
      BOOST_CHECK_NO_THROW((remesh_again<float, Tensor, Sparse>(lattice)));
      BOOST_CHECK_NO_THROW((remesh_again<float, Split, Dense>(lattice)));
    }
  }
}
