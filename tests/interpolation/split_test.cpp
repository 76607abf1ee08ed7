// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE split
#include <boost/test/unit_test.hpp>
#include <numbers>
#include <regex>

#include <cambium/interpolation.hpp>
#include <cambium/particles/totals.hpp>

#include "support/order.hpp"
#include "support/scattered.hpp"

using namespace cambium;

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// One particle for each node of a lattice of the unit box, moved by displacement(node), with random strengths.
template <int D, class T = double>
struct Scene {
  Lattice<D> lattice;
  Particles<D, T> particles;
  Attribute<T> mass = particles.template add<T>("mass");
  Attribute<Vec<2, T>> pair = particles.template add<Vec<2, T>>("pair");
  Attribute<T> age = particles.template add<T>("age", T(4));

  template <class F>
  Scene(const Lattice<D>& on, F&& displacement) : lattice(on) {
    particles.resize(lattice.size());
    const auto q = support::random_table<3, T>(lattice.size(), -0.5, 1.0, 2);
    for (std::size_t p = 0; p < lattice.size(); ++p) {
      const Vec<D> node = lattice.position(lattice.node(p));
      const Vec<D> moved = displacement(node);
      for (int d = 0; d < D; ++d) particles.positions().column(d)[p] = static_cast<T>(node[d] + moved[d]);
      particles[mass][p] = q.array[0][p];
      particles[pair].set(p, {q.array[1][p], q.array[2][p]});
      particles[age][p] = T(9);
    }
  }
};

template <int D>
Lattice<D> unit_lattice(std::ptrdiff_t n, bool periodic) {
  return periodic ? Lattice<D>::periodic_box(Box<D>::cube(), n) : Lattice<D>::bounded_box(Box<D>::cube(), n);
}

/// Largest difference of the attribute `mass` of two sets of particles.
template <int D, class T>
double difference(Scene<D, T>& a, Scene<D, T>& b) {
  double largest = 0.0;
  BOOST_REQUIRE(a.particles.size() == b.particles.size());
  for (std::size_t p = 0; p < a.particles.size(); ++p) {
    largest = std::max(largest, std::abs(static_cast<double>(a.particles[a.mass][p] - b.particles[b.mass][p])));
  }
  return largest;
}

/// The displacement a_d sin(2 pi s + d), s = x_0 + ... + x_{D-1}, different along every axis; s moves by itself.
template <int D>
struct Shear {
  Vec<D> amplitude;

  Vec<D> operator()(const Vec<D>& x) const { return at(sum(x)); }
  Vec<D> at(double s) const {
    Vec<D> moved;
    for (int d = 0; d < D; ++d) moved[d] = amplitude[d] * std::sin(two_pi * s + d);
    return moved;
  }
  double jacobian(double s) const {
    double result = 1.0;
    for (int d = 0; d < D; ++d) result += amplitude[d] * two_pi * std::cos(two_pi * s + d);
    return result;
  }
  /// s of the point that has come to x, by Newton's method.
  double origin(const Vec<D>& x) const {
    double s = sum(x);
    for (int iteration = 0; iteration < 12; ++iteration) s -= (s + sum(at(s)) - sum(x)) / jacobian(s);
    return s;
  }
  static double sum(const Vec<D>& x) { return dot(x, Vec<D>::constant(1.0)); }
};

/// Largest error of the density that a strategy gives for particles that carried wave(X) h^D along a shear, against
/// wave(X) / J, and how far the total is off.
template <class K, class Strategy, int D>
double density_error(std::ptrdiff_t n, double spacings) {
  Shear<D> shear;
  for (int d = 0; d < D; ++d) shear.amplitude[d] = spacings / static_cast<double>(n) * (d == 1 ? -0.8 : 1.0 - 0.1 * d);
  const auto wave = [](const Vec<D>& x) { return 1.0 + 0.5 * std::sin(two_pi * x[D - 1] + 0.4 + two_pi * x[0]); };
  Scene<D> scene(unit_lattice<D>(n, true), shear);
  const auto mass = scene.particles[scene.mass];
  for (std::size_t p = 0; p < scene.lattice.size(); ++p) {
    mass[p] = wave(scene.lattice.position(scene.lattice.node(p))) * scene.lattice.cell_volume();
  }
  const double before = total(mass);
  Remesher<K, Strategy>()(scene.particles, scene.lattice, scene.mass);
  BOOST_TEST(std::abs(total(scene.particles[scene.mass]) - before) <= 1e-14);
  double error = 0.0;
  for (std::size_t p = 0; p < scene.lattice.size(); ++p) {
    const Vec<D> node = scene.lattice.position(scene.lattice.node(p));
    const double s = shear.origin(node);
    const double exact = wave(node - shear.at(s)) / shear.jacobian(s);
    error = std::max(error, std::abs(scene.particles[scene.mass][p] / scene.lattice.cell_volume() - exact));
  }
  return error;
}

/// Orders of both strategies, and the ratio of their errors, with displacements of up to half a spacing.
template <class K, int D>
void compare_strategies(std::ptrdiff_t n, double least_order, double largest_ratio) {
  const double coarse = density_error<K, Split, D>(n, 0.5), fine = density_error<K, Split, D>(2 * n, 0.5);
  const double tensor = density_error<K, Tensor, D>(2 * n, 0.5);
  const double coarse_tensor = density_error<K, Tensor, D>(n, 0.5);
  BOOST_TEST_MESSAGE("D=" << D << " moments " << K::moments << " C" << K::continuity << " split " << coarse << " "
                          << fine << " order " << support::observed_order(coarse, fine) << ", tensor " << coarse_tensor
                          << " " << tensor << " order " << support::observed_order(coarse_tensor, tensor));
  BOOST_TEST(support::observed_order(coarse, fine) >= least_order);
  BOOST_TEST(fine <= largest_ratio * tensor);
}

template <class Error, class F>
void expect(const char* pattern, F&& f) {
  try {
    f();
    BOOST_TEST(false, "nothing was thrown where the message should match " << pattern);
  } catch (const Error& error) {
    BOOST_TEST(std::regex_search(error.what(), std::regex(pattern)), error.what() << " does not match " << pattern);
  }
}

}  // namespace

using Dimensions =
    std::tuple<std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

BOOST_AUTO_TEST_CASE_TEMPLATE(particles_at_rest_keep_their_strengths, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  for (const bool periodic : {true, false}) {
    const auto rest = [](const Vec<D>&) { return Vec<D>{}; };
    Scene<D> scene(unit_lattice<D>(16, periodic), rest), expected(scene.lattice, rest);
    const auto report = Remesher<M6, Split>()(scene.particles, scene.lattice, scene.pair, scene.mass);
    BOOST_TEST(difference(scene, expected) <= (periodic ? 1e-15 : 5e-15));  // weights at nodes: 0 and 1 to 1e-17
    BOOST_TEST(report.created == scene.lattice.size());
    BOOST_TEST(report.dropped_nodes == 0u);
    BOOST_TEST((report.dropped == std::tuple<Vec<2>, double>{}));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(particles_moved_alike_are_remeshed_as_by_tensor, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  for (const double spacings : {0.3, -2.7, 7.4, 8.0, 9.6, 21.3, -40.5}) {
    const auto shift = [&](const Vec<D>&) {
      Vec<D> moved;
      for (int d = 0; d < D; ++d) moved[d] = (spacings + 0.17 * d) / 16.0;
      return moved;
    };
    Scene<D> split(unit_lattice<D>(16, true), shift), tensor(split.lattice, shift);
    Remesher<M6, Split>()(split.particles, split.lattice, split.mass);
    Remesher<M6>()(tensor.particles, tensor.lattice, tensor.mass);
    // Offsets are known to eps times 40 spacings, and |W'| sums to less than 8 along each axis.
    BOOST_TEST(difference(split, tensor) <= D * 40 * 8 * 2.2e-16, "moved by " << spacings << " spacings");
    for (std::size_t p = 0; p < split.lattice.size(); ++p) {
      BOOST_REQUIRE(split.particles.positions()[p] == split.lattice.position(split.lattice.node(p)));
      BOOST_REQUIRE(split.particles[split.age][p] == 4.0);  // not named: anew
    }
  }
}

// More than 16 MiB of particles are written past the caches: rows that are whole cache lines and rows that are not.
BOOST_AUTO_TEST_CASE(sets_larger_than_caches) {
  for (const std::ptrdiff_t columns : {88, 91}) {
    const Lattice<3> lattice({{0.0, 0.0, 0.0}, {static_cast<double>(columns), 80.0, 84.0}}, 1.0, {true, true, true});
    const auto shift = [](const Vec<3>&) { return Vec<3>{0.3, -0.4, 1.2}; };
    Scene<3> split(lattice, shift), tensor(lattice, shift);
    Remesher<M6, Split>()(split.particles, lattice, split.mass);
    Remesher<M6>()(tensor.particles, lattice, tensor.mass);
    BOOST_TEST(difference(split, tensor) <= 3 * 91 * 8 * 2.2e-16);  // offsets to eps times 91 spacings along 3 axes
    for (std::size_t p = 0; p < lattice.size(); ++p) {
      BOOST_REQUIRE(split.particles.positions()[p] == lattice.position(lattice.node(p)));
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(large_displacements_that_differ, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  // Around half the period neighbours may differ by a period in the shortest way back.
  for (const double spacings : {0.0, 5.3, 7.9, 8.0, 8.1, -8.0, 16.0, 24.0}) {
    const auto move = [&](const Vec<D>& x) {
      Vec<D> moved;
      for (int d = 0; d < D; ++d) moved[d] = (spacings + 0.2 * std::sin(two_pi * (x[0] + x[D - 1]) + d)) / 16.0;
      return moved;
    };
    Scene<D> split(unit_lattice<D>(16, true), move), tensor(split.lattice, move);
    const double whole = std::floor(spacings) / 16.0;
    Scene<D> near(split.lattice, [&](const Vec<D>& x) { return move(x) - Vec<D>::constant(whole); });
    Scene<D> near_tensor = near;
    Remesher<M6, Split>()(split.particles, split.lattice, split.mass);
    Remesher<M6>()(tensor.particles, tensor.lattice, tensor.mass);
    Remesher<M6, Split>()(near.particles, near.lattice, near.mass);
    Remesher<M6>()(near_tensor.particles, near_tensor.lattice, near_tensor.mass);
    // Strengths are random: the strategies differ, but not more than for the same motion without the shift.
    BOOST_TEST(difference(split, tensor) <= 1.5 * difference(near, near_tensor) + 1e-13,
               "moved by " << spacings << " spacings: " << difference(split, tensor) << " against "
                           << difference(near, near_tensor));
  }
}

BOOST_AUTO_TEST_CASE(order_of_both_strategies) {
  // min(moments, continuity) + 1 = 3 and 5; errors of neighbouring resolutions scatter by some tenths of an order.
  compare_strategies<M6, 1>(320, 2.4, 1.0001);
  compare_strategies<Lambda44, 1>(320, 4.5, 1.0001);
  compare_strategies<M6, 2>(80, 2.4, 2.0);
  compare_strategies<Lambda44, 2>(80, 4.5, 2.0);
  compare_strategies<M6, 3>(24, 2.4, 2.0);
  compare_strategies<Lambda44, 3>(24, 4.0, 2.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(attributes_together_are_as_one_by_one, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  for (const bool periodic : {true, false}) {
    const auto move = [&](const Vec<D>& x) {  // nothing through faces
      Vec<D> moved;
      for (int d = 0; d < D; ++d) moved[d] = 0.05 * std::sin(0.5 * two_pi * x[d]) * std::cos(x[D - 1] - d);
      for (int d = 0; d < D; ++d) moved[d] *= periodic || (x[d] > 0.0 && x[d] < 1.0) ? 1.0 : 0.0;
      return moved;
    };
    Scene<D> all(unit_lattice<D>(18, periodic), move), one(all.lattice, move), other(all.lattice, move);
    const double mass = total(all.particles[all.mass]);
    const Vec<2> pair = total(all.particles[all.pair]);
    Remesher<M6, Split> remesh;
    remesh(all.particles, all.lattice, all.pair, all.mass);
    remesh(one.particles, one.lattice, one.mass);
    remesh(other.particles, other.lattice, other.pair);
    for (std::size_t p = 0; p < all.lattice.size(); ++p) {
      BOOST_REQUIRE(all.particles[all.mass][p] == one.particles[one.mass][p]);
      BOOST_REQUIRE(all.particles[all.pair][p] == other.particles[other.pair][p]);
      BOOST_REQUIRE(all.particles.positions()[p] == all.lattice.position(all.lattice.node(p)));
    }
    // n strengths of size 1; closed faces multiply some of them by up to 1e2 along each axis.
    const double tolerance = static_cast<double>(all.lattice.size()) * 2.2e-16 * (periodic ? 10.0 : 100.0);
    BOOST_TEST(std::abs(total(all.particles[all.mass]) - mass) <= tolerance);
    BOOST_TEST(norm(total(all.particles[all.pair]) - pair) <= tolerance);
  }
}

BOOST_AUTO_TEST_CASE(single_precision) {
  const auto move = [](const Vec<3>& x) { return Shear<3>{{0.02, -0.03, 0.01}}(x); };
  Scene<3, float> single(unit_lattice<3>(19, true), move);
  Scene<3> full(single.lattice, move);
  for (std::size_t p = 0; p < full.lattice.size(); ++p) full.particles[full.mass][p] = single.particles[single.mass][p];
  Remesher<M6, Split>()(single.particles, single.lattice, single.mass);
  Remesher<M6, Split>()(full.particles, full.lattice, full.mass);
  double error = 0.0;
  for (std::size_t p = 0; p < full.lattice.size(); ++p) {
    error = std::max(error, std::abs(full.particles[full.mass][p] - double{single.particles[single.mass][p]}));
  }
  BOOST_TEST(error <= 3 * 19 * 8 * 1.2e-7);  // offsets to eps times 19 spacings along 3 axes
}

BOOST_AUTO_TEST_CASE(particles_that_moved_past_each_other) {
  for (const double amplitude : {0.17, 0.2, 0.5, 1.0}) {  // 2 pi a > 1 folds; 0.17 only where it is steepest
    const auto fold = [&](const Vec<2>& x) { return Vec<2>{0.0, amplitude * std::sin(two_pi * x[1])}; };
    Scene<2> scene(unit_lattice<2>(32, true), fold);
    Scene<2> before = scene;
    expect<ValueError>("split remeshing along axis 1 .*remesh after a shorter step, or use the strategy Tensor",
                       [&] { Remesher<M6, Split>()(scene.particles, scene.lattice, scene.mass); });
    BOOST_TEST(difference(scene, before) == 0.0);
    for (std::size_t p = 0; p < scene.particles.size(); ++p) {
      BOOST_REQUIRE(scene.particles.positions()[p] == before.particles.positions()[p]);
      BOOST_REQUIRE(scene.particles[scene.age][p] == 9.0);
    }
  }
}

// A shear of up to `spacings` against the mean, with neighbours that stay ordered: exact as long as all displacements
// are less than half a period from their mean, refused beyond.
BOOST_AUTO_TEST_CASE(shears_that_reach_around_the_period) {
  const Lattice<2> lattice({{0.0, 0.0}, {1.0, 8.0}}, 1.0 / 16.0, {true, true});
  for (const double spacings : {2.0, 5.5, 7.5, 8.0, 9.0}) {
    const auto shear = [&](const Vec<2>& x) {
      return Vec<2>{(7.3 + spacings * std::sin(two_pi * x[1] / 8.0)) / 16.0, 0.0};
    };
    Scene<2> split(lattice, shear), tensor(lattice, shear);
    const auto run = [&] { Remesher<M6, Split>()(split.particles, split.lattice, split.mass); };
    if (spacings > 7.0) {
      expect<ValueError>("moved along axis 0 by up to .* against one another, which reaches around the period of 16",
                         run);
      BOOST_TEST(difference(split, tensor) == 0.0);
      continue;
    }
    run();
    Remesher<M6>()(tensor.particles, tensor.lattice, tensor.mass);
    BOOST_TEST(difference(split, tensor) <= 1e-12);  // nothing moves along axis 1: the same sums
  }
}

BOOST_AUTO_TEST_CASE(wrong_numbers) {
  const auto rest = [](const Vec<2>&) { return Vec<2>{}; };
  Scene<2> scene(unit_lattice<2>(16, true), rest);
  scene.particles.resize(255);
  expect<SizeError>("set of particles for split remeshing has 255 entries where 256 are needed",
                    [&] { Remesher<M6, Split>()(scene.particles, scene.lattice, scene.mass); });
  BOOST_TEST(scene.particles.size() == 255u);
  expect<ValueError>("threshold 0.125 for split remeshing.*must be 0; use the strategy Tensor",
                     [] { Remesher<M6, Split>({.threshold = 0.125}); });
}
