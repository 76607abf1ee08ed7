// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE interpolation_placement
#include <boost/test/unit_test.hpp>
#include <cstring>
#include <random>
#include <tuple>

#include <cambium/interpolation.hpp>
#include <cambium/kernels.hpp>

using namespace cambium;

namespace {

/// Particles at random, in no order or (every second one taken from the node of its number) in that of the lattice.
template <int D>
Particles<D> scattered(const Lattice<D>& lattice, bool ordered) {
  Particles<D> particles(lattice.size());
  std::mt19937 draw(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (std::size_t p = 0; p < particles.size(); ++p) {
    Vec<D> x = lattice.position(lattice.node(p));
    for (int d = 0; d < D; ++d) x[d] = ordered ? x[d] + 0.9 * lattice.spacing() * uniform(draw) : uniform(draw);
    particles.positions().set(p, x);
  }
  return particles;
}

using Dimensions =
    std::tuple<std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(a_placement_changes_no_bit, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  const auto lattice = Lattice<D>::periodic_box(Box<D>::cube(), D == 3 ? 20 : 40);
  for (const bool ordered : {false, true}) {
    auto particles = scattered(lattice, ordered);
    const auto mass = particles.template add<double>("mass");
    const auto found = particles.template add<double>("found");
    for (std::size_t p = 0; p < particles.size(); ++p) particles[mass][p] = std::sin(0.1 * static_cast<double>(p));
    const Particles<D>& constant = particles;

    Interpolator<M6> interpolator;
    Field<double, D> expected(lattice), mesh(lattice);
    interpolator.p2m(particles, mass, expected);
    const Placement<M6, D> placement(lattice, constant.positions());
    interpolator.p2m(placement, read_columns(constant[mass]), mesh);
    BOOST_TEST(std::memcmp(expected.data(), mesh.data(), mesh.size() * sizeof(double)) == 0);

    std::vector<double> direct(particles.size());
    interpolator.m2p(mesh, constant.positions(), Columns<1, double>(std::span<double>(direct)));
    interpolator.m2p(mesh, placement, Columns<1, double>(particles[found]));
    BOOST_TEST(std::memcmp(direct.data(), particles[found].data(), direct.size() * sizeof(double)) == 0);
  }
}

BOOST_AUTO_TEST_CASE(a_placement_knows_its_lattice_and_its_particles) {
  const auto lattice = Lattice<2>::periodic_box(Box<2>::cube(), 16);
  const auto particles = scattered(lattice, true);
  const std::vector<double> strength(particles.size(), 1.0);
  const Columns<1, const double> ones{std::span<const double>(strength)};
  Interpolator<M4Prime> interpolator;
  Field<double, 2> mesh(lattice, 7.0);

  Placement<M4Prime, 2> placement;
  BOOST_CHECK_THROW(interpolator.p2m(placement, ones, mesh), LatticeError);
  placement.update(Lattice<2>::periodic_box(Box<2>::cube(), 32), particles.positions());
  BOOST_CHECK_THROW(interpolator.p2m(placement, ones, mesh), LatticeError);
  placement.update(lattice, particles.positions());
  BOOST_TEST(placement.sorted());
  const Columns<1, const double> few{std::span<const double>(strength).first(3)};
  BOOST_CHECK_THROW(interpolator.p2m(placement, few, mesh), SizeError);
  BOOST_TEST(mesh[0] == 7.0);  // nothing was written by any of these
  interpolator.p2m(placement, ones, mesh);
  BOOST_TEST(mesh[0] != 7.0);
}
