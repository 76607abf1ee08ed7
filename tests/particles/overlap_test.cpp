// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE overlap
#include <boost/test/unit_test.hpp>
#include <limits>
#include <random>
#include <string>
#include <tuple>

#include <cambium/particles/overlap.hpp>

using namespace cambium;

namespace {

template <int D>
struct Dim {
  static constexpr int dimension = D;
};
using Dims = std::tuple<Dim<1>, Dim<2>, Dim<3>>;

template <int D>
Particles<D> nodes_of(const Lattice<D>& lattice) {
  Particles<D> particles(lattice.size());
  for (std::size_t p = 0; p < particles.size(); ++p) particles.positions().set(p, lattice.position(lattice.node(p)));
  return particles;
}

template <int D>
Particles<D> scatter(std::size_t count) {
  std::mt19937_64 random(D);
  std::uniform_real_distribution<double> unit;
  Particles<D> particles(count);
  for (std::size_t p = 0; p < count; ++p) {
    Vec<D> x;
    for (int d = 0; d < D; ++d) x[d] = unit(random);
    particles.positions().set(p, x);
  }
  return particles;
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(lattice_has_the_known_distances, C, Dims) {
  constexpr int D = C::dimension;
  const auto lattice = Lattice<D>::periodic_box(Box<D>::cube(), 8);
  const Particles<D> particles = nodes_of(lattice);
  const Overlap overlap = measure_overlap(lattice.domain(), particles.positions(), 0.25);
  BOOST_TEST(overlap.particles == particles.size());
  BOOST_TEST(overlap.smallest == 0.125);
  BOOST_TEST(overlap.mean == 0.125);
  BOOST_TEST(overlap.largest == 0.125);
  BOOST_TEST(overlap.loneliest == 0u);
  BOOST_TEST(overlap.mean_spacing == 0.125, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(overlap.ratio() == 0.5);
  BOOST_TEST(overlap.holds());
  BOOST_TEST(!measure_overlap(lattice.domain(), particles.positions(), 0.125).holds());  // h/eps = 1 is not overlap

  // The lattice of half the spacing has nodes in the centres of the cells.
  const auto finer = Lattice<D>::periodic_box(Box<D>::cube(), 16);
  const Gap<D> gap = largest_gap(finer, particles.positions());
  BOOST_TEST(gap.distance == 0.0625 * std::sqrt(1.0 * D), boost::test_tools::tolerance(1e-15));
  BOOST_TEST(gap.spacing() == 0.125, boost::test_tools::tolerance(1e-15));
  BOOST_TEST((gap.at == Vec<D>::constant(0.0625)));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(random_particles_as_brute_force, C, Dims) {
  constexpr int D = C::dimension;
  for (const bool periodic : {true, false}) {
    const auto lattice =
        periodic ? Lattice<D>::periodic_box(Box<D>::cube(), 10) : Lattice<D>::bounded_box(Box<D>::cube(), 10);
    const Domain<D>& domain = lattice.domain();
    Particles<D> particles = scatter<D>(150);
    // One half squeezed into a corner: distances differ by more than a factor of ten.
    for (std::size_t p = 0; p < 75; ++p) particles.positions().set(p, particles.positions()[p] * 0.05);
    double smallest = 1.0, sum = 0.0, largest = 0.0, distance = 0.0;
    std::size_t loneliest = 0;
    const auto closest = [&](const Vec<D>& x, std::size_t p) {
      double least = 10.0;
      for (std::size_t q = 0; q < particles.size(); ++q) {
        if (q != p) least = std::min(least, norm(domain.difference(x, particles.positions()[q])));
      }
      return least;
    };
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const double r = closest(particles.positions()[p], p);
      smallest = std::min(smallest, r);
      sum += r;
      if (r > largest) loneliest = p;
      largest = std::max(largest, r);
    }
    for (std::size_t i = 0; i < lattice.size(); ++i) {
      distance = std::max(distance, closest(lattice.position(lattice.node(i)), particles.size()));
    }
    const Overlap overlap = measure_overlap(domain, particles.positions(), 0.1);
    BOOST_TEST(overlap.smallest == smallest);
    BOOST_TEST(overlap.largest == largest);
    BOOST_TEST(overlap.loneliest == loneliest);
    BOOST_TEST(overlap.mean == sum / 150.0, boost::test_tools::tolerance(1e-13));  // another order of summation
    const Gap<D> gap = largest_gap(lattice, particles.positions());
    BOOST_TEST(gap.distance == distance);
    BOOST_TEST(closest(gap.at, particles.size()) == distance);
  }
}

BOOST_AUTO_TEST_CASE(clumps_pass_the_distances_but_not_the_gap) {
  // Pairs 0.01 apart on a lattice of spacing 1/4: every particle has a neighbour within epsilon, the field has holes.
  const auto lattice = Lattice<2>::periodic_box(Box<2>::cube(), 4);
  Particles<2> particles = nodes_of(lattice);
  particles.append(particles);
  for (std::size_t p = 16; p < 32; ++p) particles.positions().add(p, {0.01, 0.0});
  const Overlap overlap = measure_overlap(lattice.domain(), particles.positions(), 0.02);
  BOOST_TEST(overlap.holds());
  const Gap<2> gap = largest_gap(Lattice<2>::periodic_box(Box<2>::cube(), 64), particles.positions());
  BOOST_TEST(gap.spacing() > 0.02);
}

BOOST_AUTO_TEST_CASE(gap_where_it_is_asked_for) {
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 10);
  Particles<2> particles(1);
  const Gap<2> everywhere = largest_gap(lattice, particles.positions());
  BOOST_TEST(everywhere.distance == std::sqrt(2.0), boost::test_tools::tolerance(1e-15));
  const Gap<2> near = largest_gap(lattice, particles.positions(), [](const Vec<2>& x) { return norm(x) < 0.35; });
  BOOST_TEST(near.distance == std::sqrt(0.1), boost::test_tools::tolerance(1e-14));  // node (0.1, 0.3)
  BOOST_CHECK_THROW(largest_gap(lattice, particles.positions(), [](const Vec<2>&) { return false; }), SizeError);
}

BOOST_AUTO_TEST_CASE(result_does_not_depend_on_threads) {
  const auto lattice = Lattice<3>::periodic_box(Box<3>::cube(), 16);
  const Particles<3> particles = scatter<3>(5000);
  const Overlap serial = measure_overlap(lattice.domain(), particles.positions(), 0.1, Serial{});
  const Gap<3> gap = largest_gap(lattice, particles.positions(), Serial{});
  for (int threads = 1; threads <= 4; ++threads) {
    const Overlap overlap = measure_overlap(lattice.domain(), particles.positions(), 0.1, OpenMP{threads});
    BOOST_TEST((overlap.mean == serial.mean && overlap.largest == serial.largest));
    BOOST_TEST((overlap.smallest == serial.smallest && overlap.loneliest == serial.loneliest));
    const Gap<3> other = largest_gap(lattice, particles.positions(), OpenMP{threads});
    BOOST_TEST((other.distance == gap.distance && other.at == gap.at));
  }
}

BOOST_AUTO_TEST_CASE(bad_input) {
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 4);
  Particles<2> particles(2);
  const auto refuses = [](auto&& f, const std::string& part) {
    BOOST_CHECK_EXCEPTION(
        f(), Error, [&](const Error& error) { return std::string(error.what()).find(part) != std::string::npos; });
  };
  refuses([&] { measure_overlap(lattice.domain(), particles.positions(), 0.0); }, "smoothing length is 0");
  refuses([&] { measure_overlap(lattice.domain(), Particles<2>(1).positions(), 0.1); }, "overlap of 1 particle(s)");
  refuses([&] { largest_gap(lattice, Particles<2>().positions()); }, "largest gap between no particles");
  particles.positions().set(1, {2.0, 0.5});
  refuses([&] { measure_overlap(lattice.domain(), particles.positions(), 0.1); }, "particle 1 at (2, 0.5) is outside");
  refuses([&] { largest_gap(lattice, particles.positions()); }, "particle 1 at (2, 0.5) is outside");
}
