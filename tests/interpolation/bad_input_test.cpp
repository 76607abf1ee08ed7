// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE interpolation_bad_input
#include <bit>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <regex>

#include <cambium/interpolation.hpp>

#include "support/scattered.hpp"

using namespace cambium;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Calls f, which must throw exactly an E whose text matches the pattern.
template <class E, class F>
void expect(const char* pattern, F&& f) {
  try {
    f();
    BOOST_TEST(false, "nothing was thrown where the message should match " << pattern);
  } catch (const E& error) {
    BOOST_TEST(std::regex_search(error.what(), std::regex(pattern)), error.what() << " does not match " << pattern);
  }
}

/// Particles on the nodes of a lattice bounded along axis 0 and periodic along the others, on which a mesh, particles
/// and attributes are watched.
template <int D>
struct Scene {
  Lattice<D> lattice = support::lattice_of<D>(Index<D>::constant(12), 6);
  Particles<D> particles{lattice.size()};
  Attribute<double> strength = particles.template add<double>("strength", 1.5);
  Attribute<Vec<2>> pair = particles.template add<Vec<2>>("pair", Vec<2>{-0.5, 2.0});
  Attribute<double> other = particles.template add<double>("other", 4.0);

  Scene() {
    for (std::size_t p = 0; p < particles.size(); ++p) {
      particles.positions().set(p, lattice.position(lattice.node(p)));
    }
  }
};

/// Every bit of the particles; NaN is kept apart from NaN of another sign.
template <int D>
std::vector<std::vector<std::uint64_t>> bits(Particles<D>& particles) {
  std::vector<std::vector<std::uint64_t>> result;
  particles.for_each_array([&](const auto& array) {
    result.emplace_back();
    for (const auto value : array) result.back().push_back(std::bit_cast<std::uint64_t>(static_cast<double>(value)));
  });
  return result;
}

/// All the ways into the room that read positions; each must throw E and leave particles and meshes as they were.
template <class E, int D>
void expect_everywhere(const char* pattern, Scene<D>& scene, bool of_strengths) {
  auto& particles = scene.particles;
  const auto before = bits(particles);
  const std::size_t count = particles.size();
  Interpolator<M4Prime> interpolate;
  Field<double, D> dense(scene.lattice, 7.0);
  Field<double, D, Sparse> sparse(scene.lattice, 7.0);
  sparse.set(Index<D>{}, 3.0);
  expect<E>(pattern, [&] { interpolate.p2m(particles, scene.strength, dense); });
  expect<E>(pattern, [&] { interpolate.p2m(particles, scene.strength, sparse); });
  expect<E>(pattern, [&] { interpolate.p2m_renormalised(particles, scene.strength, dense); });
  expect<E>(pattern, [&] { interpolate.p2m_renormalised(particles, scene.strength, sparse); });
  if (!of_strengths) {
    expect<E>(pattern, [&] { interpolate.m2p(dense, particles, scene.strength); });
    expect<E>(pattern, [&] { interpolate.m2p(sparse, particles, scene.strength); });
  }
  expect<E>(pattern, [&] { Remesher<M4Prime>()(particles, scene.lattice, scene.pair, scene.strength); });
  expect<E>(pattern, [&] { Remesher<M4Prime, Split>()(particles, scene.lattice, scene.pair, scene.strength); });
  BOOST_TEST((dense.values()[0] == 7.0 && std::count(dense.values().begin(), dense.values().end(), 7.0) ==
                                              static_cast<std::ptrdiff_t>(dense.size())));
  BOOST_TEST((sparse.blocks() == 1u && std::as_const(sparse)(Index<D>{}) == 3.0));
  BOOST_TEST(particles.size() == count);
  BOOST_TEST((bits(particles) == before));
}

}  // namespace

using Dimensions = std::tuple<std::integral_constant<int, 1>, std::integral_constant<int, 3>>;

BOOST_AUTO_TEST_CASE_TEMPLATE(positions_that_cannot_be, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  for (const double wrong : {not_a_number, infinity, -infinity}) {
    Scene<D> scene;
    scene.particles.positions().column(D - 1)[5] = wrong;
    expect_everywhere<PositionError>(
        D == 1 ? "particle 5 has position .*(nan|inf).*component 0 is not finite; check the velocity"
               : "particle 5 has position .*(nan|inf).*component [12] is not finite; check the velocity",
        scene, false);
  }
  for (const double wrong : {-0.30001, 12.0}) {
    Scene<D> scene;
    scene.particles.positions().column(0)[7] = wrong;
    scene.particles.positions().column(0)[9] = wrong;
    expect_everywhere<PositionError>(
        "particle 7 at .* is outside the bounded box .* along axis 0: enlarge the box or remove the particle", scene,
        false);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(strengths_that_cannot_be, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  for (const double wrong : {not_a_number, infinity, -infinity}) {
    Scene<D> scene;
    scene.particles[scene.strength][6] = wrong;
    expect_everywhere<ValueError>("particle 6.*(nan|inf).*must be finite", scene, true);
  }
  // A second attribute that is wrong, in its second component, must not cost the first.
  Scene<D> scene;
  scene.particles[scene.pair].set(8, {1.0, not_a_number});
  const auto before = bits(scene.particles);
  const char* pattern = "strength of particle 8 is -?nan in component 1";
  expect<ValueError>(pattern, [&] { Remesher<M4Prime>()(scene.particles, scene.lattice, scene.strength, scene.pair); });
  expect<ValueError>(pattern,
                     [&] { Remesher<M4Prime, Split>()(scene.particles, scene.lattice, scene.strength, scene.pair); });
  BOOST_TEST((bits(scene.particles) == before));
}

BOOST_AUTO_TEST_CASE(very_large_strengths_are_finite) {
  Scene<2> scene;
  scene.particles[scene.strength][6] = 1e308;
  Field<double, 2> mesh(scene.lattice);
  Interpolator<M4Prime>().p2m(scene.particles, scene.strength, mesh);
  BOOST_TEST(mesh[6] == 1e308, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(lattices_smaller_than_the_kernel, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  for (const unsigned periodic : {0u, 7u}) {
    auto nodes = Index<D>::constant(12);
    nodes[D - 1] = 3;
    Scene<D> scene;
    scene.lattice = support::lattice_of<D>(nodes, periodic);
    scene.particles.resize(scene.lattice.size());
    expect_everywhere<LatticeError>(
        "lattice has 3 nodes along axis [012] but the kernel needs at least 4: refine the lattice", scene, false);
  }
}

BOOST_AUTO_TEST_CASE(arrays_of_unequal_length) {
  const auto lattice = support::lattice_of<2>({12, 12}, 0);
  const auto x = support::random_positions<2>(lattice, 10, 1);
  const support::Table<1, double> strength(9, 1.0);
  support::Table<1, double> value(11, -2.0);
  const auto value_before = value;
  Field<double, 2> mesh(lattice, 7.0);
  Interpolator<M4Prime> interpolate;
  expect<SizeError>("array of strengths has 9 entries where 10 are needed",
                    [&] { interpolate.p2m(x.read(), strength.read(), mesh); });
  expect<SizeError>("array of values has 11 entries where 10 are needed",
                    [&] { interpolate.m2p(mesh, x.read(), value.write()); });
  expect<SizeError>("array of values has 9 entries where 10 are needed",
                    [&] { interpolate.p2m_renormalised(x.read(), strength.read(), mesh); });
  BOOST_TEST(std::count(mesh.values().begin(), mesh.values().end(), 7.0) == 144);
  BOOST_TEST((value == value_before));
}

BOOST_AUTO_TEST_CASE(attributes_of_other_particles) {
  Scene<2> scene;
  const auto before = bits(scene.particles);
  expect<AttributeError>("belongs to other particles", [&] {
    Remesher<M4Prime>()(scene.particles, scene.lattice, scene.strength, Attribute<float>{1});
  });
  expect<AttributeError>("belongs to other particles",
                         [&] { Remesher<M4Prime, Split>()(scene.particles, scene.lattice, Attribute<double>{9}); });
  BOOST_TEST((bits(scene.particles) == before));
}
