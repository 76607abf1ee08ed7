// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>

#include <cambium/levelset/reinitialisation.hpp>

#include "support/ellipsoid_band.hpp"
#include "support/order.hpp"

namespace marching {

using namespace cambium;

template <int D>
using Dimension = std::integral_constant<int, D>;
using Dimensions = std::tuple<Dimension<2>, Dimension<3>>;

template <class R, class T, int D, class E = Serial>
ReinitReport reinitialise(NarrowBand<T, D>& band, const E& execution = {}) {
  typename R::template Method<T, D> method{typename R::Params{}};
  return method(band, execution);
}

template <class T, int D>
NarrowBand<T, D> ellipsoid_band(int n, double half_width, bool scaled) {
  const auto shape = support::ellipsoid<D>();
  const auto lattice = Lattice<D>::bounded_box(Box<D>::cube(), n);
  return support::make_band<T, D>(
      lattice, half_width, [&](const Vec<D>& x) { return shape.distance(x); },
      [&](const Vec<D>& x) { return scaled ? shape.scaled(x) : shape.distance(x); });
}

/// Orders measured on the finer two of three lattices: `near` within two spacings of the interface, `far` in a band of
/// fixed width. As nodes next to the interface are (nearly) exact, the error in the band grows from a spacing or two
/// off it: like h^p (1 - c h), so that orders come up to p from below.
struct Orders {
  double near = 0.0;
  double far = 0.0;
};

template <class R, int D>
Orders measured_orders(bool scaled) {
  constexpr double width = 0.12;
  Orders orders;
  double near = 0.0, far = 0.0;
  for (const int n : D == 2 ? std::array{80, 160, 320} : std::array{28, 56, 112}) {
    auto band = ellipsoid_band<double, D>(n, width, scaled);
    const ReinitReport report = reinitialise<R>(band);
    BOOST_TEST(report.lower_order == 0U);
    BOOST_TEST(report.not_converged == 0U);
    const auto exact = [&](const Vec<D>& x) { return support::ellipsoid<D>().distance(x); };
    const double near_now = support::largest_error(band, 2.0 / n, exact);
    const double far_now = support::largest_error(band, 0.9 * width, exact);
    BOOST_TEST_MESSAGE(D << "D n = " << n << (scaled ? " scaled" : "") << ": " << near_now * n << " h within 2 h, "
                         << far_now * n << " h in the band");
    if (near > 0.0) {
      orders.near = support::observed_order(near, near_now);
      orders.far = support::observed_order(far, far_now);
    }
    near = near_now;
    far = far_now;
  }
  BOOST_TEST_MESSAGE("orders " << orders.near << " and " << orders.far);
  return orders;
}

/// What every reinitialisation leaves: see Reinitialisation.
template <class R, class T, int D>
void check_contract() {
  auto band = ellipsoid_band<T, D>(30, 0.15, true);
  const auto before = band;
  const ReinitReport report = reinitialise<R>(band);
  std::size_t nodes = 0;
  bool sides_kept = true, far_exact = true;
  BOOST_REQUIRE(band.blocks() == before.blocks());
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      const T phi = band.values().block(b)[i];
      nodes += band.in_band(phi);
      sides_kept &= (phi < T(0)) == (before.values().block(b)[i] < T(0));
      far_exact &= band.in_band(phi) || std::abs(phi) == band.half_width();
      far_exact &= band.lattice().contains(band.values().node(b, i)) || !band.in_band(phi);
    }
  }
  BOOST_TEST(sides_kept);
  BOOST_TEST(far_exact);
  BOOST_TEST(nodes == report.nodes);
  BOOST_TEST(report.iterations > 0U);
}

/// Many balls that overlap, touch and lie across the periodic faces of a lattice whose last blocks are thin.
template <class T, int D>
NarrowBand<T, D> balls_band(int n, double shift, double half_width) {
  const auto lattice = Lattice<D>::periodic_box(Box<D>::cube(), n);
  const auto phi = [&](const Vec<D>& x) {
    double least = 1e300;
    for (int k = 0; k < 5; ++k) {
      Vec<D> centre;
      for (int d = 0; d < D; ++d) centre[d] = std::fmod(0.31 + 0.37 * k + 0.23 * d * (k + 1), 1.0) + shift;
      least = std::min(least, norm(lattice.domain().difference(x, lattice.domain().wrap(centre))) - 0.1 - 0.02 * k);
    }
    return least;
  };
  return support::make_band<T, D>(lattice, half_width, phi, phi);
}

/// Largest difference of two bands at the same nodes, b being shifted by `shift` nodes along every axis.
template <class T, int D>
double difference(const NarrowBand<T, D>& a, const NarrowBand<T, D>& b, std::ptrdiff_t shift = 0) {
  double largest = 0.0;
  support::for_each_value(a, [&](const Index<D>& node, T value) {
    const T other = b(b.inside(node + Index<D>::constant(shift)));
    largest = std::max(largest, std::abs(static_cast<double>(value) - static_cast<double>(other)));
  });
  return largest;
}

/// A shape that lies across periodic faces, and across the thin blocks there, gets the distances that it gets
/// elsewhere.
template <class R, int D>
void check_periodic_faces() {
  constexpr int n = 36;
  auto here = balls_band<double, D>(n, 0.0, 5.0 / n);
  auto there = balls_band<double, D>(n, 13.0 / n, 5.0 / n);
  reinitialise<R>(here);
  reinitialise<R>(there);
  // Order among equal values may differ; the values are those of one scheme.
  BOOST_TEST(difference(here, there, 13) < 1e-12);
}

template <class R, int D>
void check_threads() {
  const auto start = balls_band<double, D>(36, 0.0, 5.0 / 36);
  auto one = start;
  reinitialise<R>(one, OpenMP{1});
  for (const int threads : {2, 3}) {
    auto several = start;
    reinitialise<R>(several, OpenMP{threads});
    bool same = true;
    for (std::size_t b = 0; b < one.blocks(); ++b) {
      same &= std::memcmp(one.values().block(b).data(), several.values().block(b).data(),
                          one.values().block(b).size_bytes()) == 0;
    }
    BOOST_TEST(same);
  }
}

/// phi that is not finite next to the interface: an error, and the band as it was.
template <class R>
void check_not_finite() {
  auto band = ellipsoid_band<double, 2>(30, 0.1, false);
  bool done = false;
  support::for_each_value(band, [&](const Index<2>& node, double value) {
    if (done || !(std::abs(value) < 0.01)) return;
    band.values().set(node, std::numeric_limits<double>::quiet_NaN());
    done = true;
  });
  const auto before = band;
  BOOST_CHECK_THROW(reinitialise<R>(band), ValueError);
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    BOOST_TEST(std::memcmp(band.values().block(b).data(), before.values().block(b).data(),
                           before.values().block(b).size_bytes()) == 0);
  }
}

/// Balls that touch within less than a spacing: finite distances on the right sides, whatever falls back.
template <class R, int D>
void check_touching_balls() {
  for (int k = 0; k < 8; ++k) {
    const auto lattice = Lattice<D>::bounded_box(Box<D>::cube(), 20);
    Vec<D> left = Vec<D>::constant(0.5), right = Vec<D>::constant(0.5);
    left[0] = 0.29 + 0.006 * k;
    right[0] = 0.7;
    right[1] = 0.52;
    const auto balls = [&](const Vec<D>& x) { return std::min(norm(x - left), norm(x - right)) - 0.2; };
    auto band = support::make_band<double, D>(lattice, 0.14, balls, balls);
    reinitialise<R>(band);
    double largest = 0.0;
    support::for_each_value(band, [&](const Index<D>& node, double value) {
      const double exact = balls(lattice.position(node));
      BOOST_REQUIRE(std::isfinite(value));
      BOOST_REQUIRE((value < 0.0) == (exact < 0.0));
      if (exact > 0.0 && exact < 0.1) largest = std::max(largest, std::abs(value - exact));
    });
    // Outside the balls the distance is exact but for the neck, which the values on the lattice do not tell to more
    // than about a spacing.
    BOOST_TEST(largest * 20 < 0.8);
  }
}

/// Calls of operator new, counted by the test that includes this header (one to an executable).
inline std::size_t allocations = 0;

/// A second call of the same shape takes no memory.
template <class R>
void check_no_allocation() {
  const auto start = ellipsoid_band<double, 3>(40, 0.12, true);
  typename R::template Method<double, 3> method{typename R::Params{}};
  auto first = start;
  method(first, Serial{});
  auto second = start;
  const std::size_t before = allocations;
  method(second, Serial{});
  BOOST_TEST(allocations == before);
  BOOST_TEST(difference(first, second) == 0.0);
}

}  // namespace marching

// Not inlined: g++ 12 warns of new and delete that do not match where it sees through one of them alone.
[[gnu::noinline]] void* operator new(std::size_t bytes) {
  ++marching::allocations;
  if (void* memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
