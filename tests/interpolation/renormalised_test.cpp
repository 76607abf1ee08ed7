// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE p2m_renormalised
#include <boost/test/unit_test.hpp>

#include <cambium/interpolation.hpp>

#include "support/order.hpp"
#include "support/scattered.hpp"

using namespace cambium;

namespace {

template <class S>
struct Storage {
  using type = S;
};
using Storages = std::tuple<Storage<Dense>, Storage<Sparse>>;

/// Scattered particles, about ten in a cell, in the part [0.3, 0.5] of the box.
struct Scene {
  Lattice<2> lattice = support::lattice_of<2>({100, 100}, 3, 0.01);
  Particles<2> particles{4000};
  Attribute<double> value = particles.add<double>("value");
  Attribute<Vec<2>> pair = particles.add<Vec<2>>("pair");

  Scene() {
    const auto x = support::random_positions<2>(lattice, particles.size(), 1, 0.3, 0.5);
    for (std::size_t p = 0; p < particles.size(); ++p) particles.positions().set(p, x.read()[p]);
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(constants_stay_and_the_rest_takes_the_fallback, S, Storages) {
  Scene scene;
  const auto value = scene.particles[scene.value];
  std::fill(value.begin(), value.end(), 3.7);
  for (std::size_t p = 0; p < value.size(); ++p) scene.particles[scene.pair].set(p, {3.7, -11.0});
  for (const double smallest : {0.1, 1.0, 1e9}) {
    Field<double, 2, typename S::type> mesh(scene.lattice, -7.0), weight(scene.lattice);
    Field<Vec<2>, 2, typename S::type> vectors(scene.lattice, Vec<2>{-7.0, -7.0});
    const Coverage coverage =
        p2m_renormalised<M4Prime>(scene.particles, scene.value, mesh, {.smallest_weight = smallest, .fallback = -1.0});
    p2m_renormalised<M4Prime>(scene.particles, scene.pair, vectors,
                              {.smallest_weight = smallest, .fallback = {-1.0, -2.0}});
    Particles<2> unit = scene.particles;
    std::fill(unit[scene.value].begin(), unit[scene.value].end(), 1.0);
    p2m<M4Prime>(unit, scene.value, weight);
    std::size_t uncovered = 0, background = 0;
    double lowest = 1.0;
    support::for_each_lattice_node(scene.lattice, [&](const Index<2>& node) {
      const double found = std::as_const(mesh)(node), sum = std::as_const(weight)(node);
      const Vec<2> both = std::as_const(vectors)(node);
      if (found == -7.0) {  // a node of a sparse mesh in a block without particles
        ++background;
        BOOST_REQUIRE(sum == 0.0);
        BOOST_REQUIRE((both == Vec<2>{-7.0, -7.0}));
      } else if (sum < smallest) {
        ++uncovered;
        BOOST_REQUIRE(found == -1.0);
        BOOST_REQUIRE((both == Vec<2>{-1.0, -2.0}));
      } else {
        // Weights of both signs: round-off grows with sum |W| / sum W, up to 1.6 x 30 particles / 0.1.
        lowest = std::min(lowest, sum);
        BOOST_REQUIRE(std::abs(found - 3.7) <= 3.7 * 480 * 2.2e-16);
        BOOST_REQUIRE(norm(both - Vec<2>{3.7, -11.0}) <= 11.0 * 480 * 2.2e-16);
      }
    });
    BOOST_TEST(coverage.uncovered == uncovered);
    BOOST_TEST(coverage.smallest_weight == lowest, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(uncovered > 0u);
    BOOST_TEST((background > 0) == (std::is_same_v<typename S::type, Sparse>));
    if (smallest > 1e8) BOOST_TEST(coverage.smallest_weight == 1.0);
  }
}

/// Largest error of a wave given at scattered particles, n^2 cells with 16 particles each, on all nodes.
template <class K>
double scattered_error(std::ptrdiff_t n) {
  const auto lattice = Lattice<2>::periodic_box(Box<2>::cube(), n);
  const auto wave = [](const Vec<2>& x) { return std::sin(6.283185307179586 * (x[0] - x[1]) + 0.3); };
  const auto x = support::random_positions<2>(lattice, static_cast<std::size_t>(16 * n * n), 4);
  support::Table<1, double> value(x.size());
  for (std::size_t p = 0; p < x.size(); ++p) value.array[0][p] = wave(x.read()[p]);
  Field<double, 2> mesh(lattice);
  const auto coverage = Interpolator<K>().p2m_renormalised(x.read(), value.read(), mesh);
  BOOST_TEST(coverage.uncovered == 0u);
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.size(); ++i) sum += std::pow(mesh[i] - wave(lattice.position(lattice.node(i))), 2);
  return std::sqrt(sum / static_cast<double>(mesh.size()));
}

// The mean of the values around a node differs from the value there by the gradient times the mean distance of the
// particles, which scatters about zero with the spacing: order 1, here with 16 particles in a cell. No kernel is
// better: its moments hold on the lattice, not on scattered particles.
BOOST_AUTO_TEST_CASE(values_of_scattered_particles_are_of_first_order) {
  const double coarse = scattered_error<M4>(16), middle = scattered_error<M4>(32), fine = scattered_error<M4>(64);
  BOOST_TEST(fine <= 0.03);
  BOOST_TEST(support::observed_order(coarse, middle) >= 0.8);
  BOOST_TEST(support::observed_order(middle, fine) >= 0.8);
}

BOOST_AUTO_TEST_CASE(no_particles_leave_everything_uncovered) {
  const auto lattice = support::lattice_of<2>({9, 8}, 1);
  Particles<2> particles;
  const auto value = particles.add<double>("value");
  Field<double, 2> mesh(lattice, -7.0);
  const auto coverage = p2m_renormalised<M4Prime>(particles, value, mesh, {.fallback = 5.0});
  BOOST_TEST(coverage.uncovered == 72u);
  BOOST_TEST(coverage.smallest_weight == 1.0);
  BOOST_TEST(std::count(mesh.values().begin(), mesh.values().end(), 5.0) == 72);
}
