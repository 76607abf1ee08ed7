// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE neighbours
#include <boost/test/unit_test.hpp>
#include <limits>
#include <random>
#include <string>
#include <tuple>

#include <cambium/particles/neighbours.hpp>

using namespace cambium;

namespace {

template <int D, class T>
struct Case {
  static constexpr int dimension = D;
  using Scalar = T;
};
using Cases = std::tuple<Case<1, double>, Case<2, double>, Case<3, double>, Case<3, float>>;

/// A box away from the origin with unequal sides; bit d of `periodic` makes axis d periodic.
template <int D>
Domain<D> box_with(unsigned periodic) {
  Domain<D> domain;
  for (int d = 0; d < D; ++d) {
    domain.box.lo[d] = -0.5 + 0.25 * d;
    domain.box.hi[d] = domain.box.lo[d] + 1.0 + 0.5 * d;
    domain.periodic[d] = ((periodic >> d) & 1u) != 0;
  }
  return domain;
}

/// Random particles inside the box; along periodic axes some lie several periods away.
template <int D, class T>
Particles<D, T> scatter(const Domain<D>& domain, std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.001, 0.999);
  std::uniform_int_distribution<int> image(-2, 2);
  Particles<D, T> particles(count);
  for (std::size_t p = 0; p < count; ++p) {
    Vec<D, T> x;
    for (int d = 0; d < D; ++d) {
      const double period = domain.box.extent()[d];
      x[d] = static_cast<T>(domain.box.lo[d] + period * (unit(random) + (domain.periodic[d] ? image(random) : 0)));
    }
    particles.positions().set(p, x);
  }
  return particles;
}

template <int D, class T>
Vec<D> wrapped(const Domain<D>& domain, const Vec<D, T>& x) {
  Vec<D> result;
  for (int d = 0; d < D; ++d) result[d] = static_cast<double>(x[d]);
  return domain.wrap(result);
}

template <int D>
using Found = std::vector<std::pair<std::size_t, Vec<D>>>;

/// Every particle within the radius, by trying all of them.
template <int D, class T>
Found<D> brute_force(const Domain<D>& domain, const Particles<D, T>& particles, const Vec<D>& at, double radius) {
  Found<D> found;
  for (std::size_t q = 0; q < particles.size(); ++q) {
    const Vec<D> r = domain.difference(domain.wrap(at), wrapped(domain, particles.positions()[q]));
    if (dot(r, r) <= radius * radius) found.emplace_back(q, r);
  }
  return found;
}

template <int D>
bool equal(const Found<D>& a, const Found<D>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.first == y.first && x.second == y.second;  // to the last bit
  });
}

template <int D, class T>
Found<D> found_by(const Neighbours<D, T>& near, const Vec<D>& at) {
  Found<D> found;
  near.for_each(at, [&](std::size_t q, const Vec<D>& r) { found.emplace_back(q, r); });
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return found;
}

/// Radii from a fraction of the particle distance to half the shortest period (one cell would do along every axis).
constexpr std::array radii{0.02, 0.11, 0.3, 0.34, 0.45, 0.5};

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(points_find_what_brute_force_finds, C, Cases) {
  constexpr int D = C::dimension;
  using T = typename C::Scalar;
  for (unsigned periodic = 0; periodic < (1u << D); ++periodic) {
    const Domain<D> domain = box_with<D>(periodic);
    for (const std::size_t count : {1, 7, 300}) {
      const Particles<D, T> particles = scatter<D, T>(domain, count, 7 * periodic + D);
      Neighbours<D, T> near;
      for (const double radius : radii) {
        near.build(domain, particles.positions(), radius, OpenMP{2});
        const Particles<D> points =
            scatter<D, double>(Domain<D>{domain.box, Domain<D>::periodic_box({}).periodic}, 40, 3);
        for (std::size_t i = 0; i < points.size(); ++i) {  // outside of the box, too
          const Vec<D> at = points.positions()[i];
          BOOST_TEST(equal<D>(found_by(near, at), brute_force(domain, particles, at, radius)));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(pairs_are_met_once_and_antisymmetrically, C, Cases) {
  constexpr int D = C::dimension;
  using T = typename C::Scalar;
  for (unsigned periodic = 0; periodic < (1u << D); ++periodic) {
    const Domain<D> domain = box_with<D>(periodic);
    const Particles<D, T> particles = scatter<D, T>(domain, 200, 11 * periodic + D);
    for (const double radius : radii) {
      const Neighbours<D, T> near(domain, particles.positions(), radius);
      std::vector<Found<D>> by_pair(particles.size());
      near.for_each_pair([&](std::size_t p, std::size_t q, const Vec<D>& r) {
        by_pair[p].emplace_back(q, r);
        by_pair[q].emplace_back(p, -r);
      });
      for (std::size_t p = 0; p < particles.size(); ++p) {
        Found<D> single;
        near.for_each_neighbour(p, [&](std::size_t q, const Vec<D>& r) { single.emplace_back(q, r); });
        Found<D> brute = brute_force(domain, particles, wrapped(domain, particles.positions()[p]), radius);
        std::erase_if(brute, [&](const auto& entry) { return entry.first == p; });
        for (auto* found : {&single, &by_pair[p]}) {
          std::sort(found->begin(), found->end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        }
        BOOST_TEST(equal<D>(single, brute));
        BOOST_TEST(equal<D>(by_pair[p], brute));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(nearest_is_found_however_far, C, Cases) {
  constexpr int D = C::dimension;
  using T = typename C::Scalar;
  for (unsigned periodic = 0; periodic < (1u << D); ++periodic) {
    const Domain<D> domain = box_with<D>(periodic);
    for (const std::size_t count : {1, 5, 200}) {
      const Particles<D, T> particles = scatter<D, T>(domain, count, 5 * periodic + D);
      const Particles<D> points =
          scatter<D, double>(Domain<D>{domain.box, Domain<D>::periodic_box({}).periodic}, 40, 8);
      const Neighbours<D, T> near(domain, particles.positions(), 0.003);  // far below the distances
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec<D> at = points.positions()[i];
        for (const std::size_t excluded : {std::size_t{0}, near.no_particle}) {
          double least = std::numeric_limits<double>::infinity();
          for (std::size_t q = 0; q < count; ++q) {
            const Vec<D> r = domain.difference(domain.wrap(at), wrapped(domain, particles.positions()[q]));
            if (q != excluded) least = std::min(least, norm(r));
          }
          const auto found = near.nearest(at, excluded);
          BOOST_TEST(found.has_value() == (count > (excluded == 0 ? 1u : 0u)));
          if (found) BOOST_TEST(norm(found->r) == least);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(nearest_of_equals_has_the_lowest_number) {
  Particles<1> particles(3);
  const double x[] = {0.75, 0.25, 0.25};
  for (std::size_t p = 0; p < 3; ++p) particles.positions().set(p, {x[p]});
  const Neighbours<1> near(Domain<1>::periodic_box(Box<1>::cube()), particles.positions(), 0.4);
  BOOST_TEST(near.nearest(Vec<1>{0.5})->particle == 0u);
  BOOST_TEST(near.nearest(Vec<1>{0.4})->particle == 1u);
  BOOST_TEST(near.nearest(Vec<1>{0.25}, 1)->particle == 2u);
  BOOST_CHECK_THROW((void)near.nearest(Vec<1>{std::numeric_limits<double>::infinity()}), PositionError);
}

BOOST_AUTO_TEST_CASE(lattice_ties_are_met_once) {
  // Distances of exactly the radius, and of exactly half the period, on particles that sit on cell faces.
  for (const std::ptrdiff_t n : {2, 3, 4, 5, 8}) {
    const auto lattice = Lattice<2>::periodic_box(Box<2>::cube(), n);
    Particles<2> particles(lattice.size());
    for (std::size_t p = 0; p < particles.size(); ++p) particles.positions().set(p, lattice.position(lattice.node(p)));
    for (std::ptrdiff_t k = 1; 2 * k <= n; ++k) {
      const double radius = static_cast<double>(k) * lattice.spacing();
      const Neighbours<2> near(lattice.domain(), particles.positions(), radius);
      for (std::size_t p = 0; p < particles.size(); ++p) {
        const Vec<2> at = particles.positions()[p];
        BOOST_TEST(equal<2>(found_by(near, at), brute_force(lattice.domain(), particles, at, radius)));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(result_does_not_depend_on_threads) {
  const Domain<3> domain = box_with<3>(5);
  const Particles<3> particles = scatter<3, double>(domain, 20000, 1);
  const auto sequence = [&](const auto& execution) {
    std::vector<double> result;
    const Neighbours<3> near(domain, particles.positions(), 0.03, execution);
    near.for_each_pair([&](std::size_t p, std::size_t q, const Vec<3>& r) {
      result.insert(result.end(), {static_cast<double>(p), static_cast<double>(q), r[0], r[1], r[2]});
    });
    return result;
  };
  const auto serial = sequence(Serial{});
  BOOST_TEST(serial.size() > 10000u);
  for (int threads = 1; threads <= 4; ++threads) BOOST_TEST((sequence(OpenMP{threads}) == serial));
}

BOOST_AUTO_TEST_CASE(clustered_and_flat_boxes) {
  // A box 10^6 times as long as it is wide, and all particles in a corner of it: cells stay as few as the particles.
  const Domain<2> domain = Domain<2>::bounded_box({{0.0, 0.0}, {1e3, 1e-3}});
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit;
  Particles<2> particles(300);
  for (std::size_t p = 0; p < 300; ++p) particles.positions().set(p, {0.01 * unit(random), 1e-3 * unit(random)});
  const Neighbours<2> near(domain, particles.positions(), 1e-4);
  for (std::size_t p = 0; p < 300; ++p) {
    const Vec<2> at = particles.positions()[p];
    BOOST_TEST(equal<2>(found_by(near, at), brute_force(domain, particles, at, 1e-4)));
  }
  const Neighbours<2> none(domain, Particles<2>().positions(), 1.0);
  BOOST_TEST(found_by(none, Vec<2>{0.0, 0.0}).empty());
  none.for_each_pair([](std::size_t, std::size_t, const Vec<2>&) { BOOST_TEST(false); });
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused_and_the_last_build_kept) {
  const Domain<2> domain{{{0.0, 0.0}, {1.0, 2.0}}, {true, false}};
  Particles<2> particles = scatter<2, double>(domain, 50, 2);
  Neighbours<2> near(domain, particles.positions(), 0.3);
  const auto before = found_by(near, Vec<2>{0.5, 0.5});

  const auto refuses = [&]<class Error>(const Error*, const Domain<2>& box, double radius, const std::string& part) {
    BOOST_CHECK_EXCEPTION(near.build(box, particles.positions(), radius), Error, [&](const Error& error) {
      BOOST_TEST_MESSAGE(error.what());
      return std::string(error.what()).find(part) != std::string::npos;
    });
    BOOST_TEST(equal<2>(found_by(near, Vec<2>{0.5, 0.5}), before));
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const ValueError* value = nullptr;
  refuses(value, domain, 0.0, "neighbour radius is 0: it must be a positive");
  refuses(value, domain, -1.0, "neighbour radius is -1");
  refuses(value, domain, nan, "neighbour radius is nan");
  refuses(value, domain, 0.51, "is larger than half the period 1 of axis 0");
  const LatticeError* lattice = nullptr;
  refuses(lattice, Domain<2>{{{0.0, 0.0}, {1.0, 0.0}}, {}}, 0.1, "extent 0 along axis 1");
  const PositionError* position = nullptr;
  const Vec<2> sound = particles.positions()[17];
  particles.positions().set(17, {0.5, 2.5});
  refuses(position, domain, 0.3, "particle 17 at (0.5, 2.5) is outside the bounded box (0, 0) to (1, 2) along axis 1");
  particles.positions().set(17, {nan, 0.5});
  refuses(position, domain, 0.3, "particle 17 has position (nan, 0.5): component 0 is not finite");
  particles.positions().set(17, {std::numeric_limits<double>::infinity(), 0.5});
  refuses(position, domain, 0.3, "particle 17 has position (inf, 0.5): component 0 is not finite");
  particles.positions().set(17, sound);
  BOOST_CHECK_THROW(near.for_each(Vec<2>{nan, 0.0}, [](std::size_t, const Vec<2>&) {}), PositionError);
}
