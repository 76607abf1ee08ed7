// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE levelset_particle_corrected
#include <boost/test/unit_test.hpp>
#include <limits>
#include <numbers>

#include <cambium/levelset/advection/lagrangian.hpp>
#include <cambium/levelset/advection/particle_corrected.hpp>

#include "levelset/advection_scenes.hpp"

using namespace cambium;
using namespace advection_scenes;

namespace {

/// A base that is made to err: remeshing by M4' followed, every step, by a reinitialisation.
using Base = Lagrangian<M4Prime>;
using Corrected = ParticleCorrected<Base>;

const Corrected::Params often{.base = {.largest_distortion = 0.9, .octaves = 100.0}, .reinitialise_every = 1};

struct Result {
  double difference;  ///< area between the interface and where it should be, over its length, in spacings
  double area;        ///< relative error
};

template <class F, class V>
Result advance(const Lattice<2>& lattice, const F& shape, double perimeter, const V& velocity, double end, int steps,
               bool corrected) {
  LevelSet<ClosestPoint, 2, double> level_set(lattice, shape, {}, Serial{});
  const double area = enclosed(level_set);
  Corrected particles(often);
  Base base(often.base);
  const double dt = end / steps;
  for (int k = 0; k < steps; ++k) {
    if (corrected) {
      particles.step(level_set, velocity, k * dt, dt, Serial{});
    } else {
      base.step(level_set, velocity, k * dt, dt, Serial{});
      level_set.reinitialise(Serial{});
    }
  }
  return {symmetric_difference(level_set, shape) / perimeter / lattice.spacing(), enclosed(level_set) / area - 1.0};
}

}  // namespace

// One turn of Zalesak's disk in 128 steps, in a box large enough for the band to turn in.
BOOST_AUTO_TEST_CASE(zalesaks_disk_keeps_its_corners) {
  const Lattice<2> lattice(Box<2>{{-10.0, -10.0}, {110.0, 110.0}}, 1.0, {false, false});
  const double perimeter = 30.0 * std::numbers::pi - 5.0 + 50.0;
  const Result base = advance(lattice, SlottedDisk{}, perimeter, Rotation<2>{50.0}, 1.0, 128, false);
  const Result both = advance(lattice, SlottedDisk{}, perimeter, Rotation<2>{50.0}, 1.0, 128, true);
  BOOST_TEST_MESSAGE("slotted disk: base " << base.difference << " h " << base.area << ", corrected " << both.difference
                                           << " h " << both.area);
  BOOST_TEST(both.difference < 0.6 * base.difference);
  BOOST_TEST(std::abs(both.area) < 0.6 * std::abs(base.area));
  BOOST_TEST(both.difference < 0.12);
}

BOOST_AUTO_TEST_CASE(a_vortex_loses_less) {
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 64);
  const Ball<2> disk{{0.5, 0.75}, 0.15};
  const double perimeter = 0.3 * std::numbers::pi;
  const Result base = advance(lattice, disk, perimeter, Vortex<double>{2.0}, 2.0, 128, false);
  const Result both = advance(lattice, disk, perimeter, Vortex<double>{2.0}, 2.0, 128, true);
  BOOST_TEST_MESSAGE("vortex: base " << base.difference << " h " << base.area << ", corrected " << both.difference
                                     << " h " << both.area);
  BOOST_TEST(both.difference < 0.5 * base.difference);
  BOOST_TEST(std::abs(both.area) < 0.5 * std::abs(base.area));
}

// What the rules of seeding promise, in 2D and 3D: every marker is on its side, within the width of the interface, and
// a ball that does not reach across it; on average as many in a cell as were asked for.
using Dimensions = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
BOOST_AUTO_TEST_CASE_TEMPLATE(markers_are_seeded_on_both_sides, Dim, Dimensions) {
  constexpr int D = Dim::value;
  const auto lattice = Lattice<D>::periodic_box(Box<D>::cube(), 32);
  const double h = lattice.spacing();
  const LevelSet<ClosestPoint, D, double> level_set(lattice, Ball<D>{}, {}, Serial{});
  Markers<double, D> markers;
  markers.read(level_set.band(), Serial{});
  markers.reseed(level_set.band(), {}, 0, Serial{});
  std::size_t outside = 0;
  for (std::size_t p = 0; p < markers.size(); ++p) {
    const double distance = Ball<D>{}(std::as_const(markers).positions()[p]);
    const double radius = markers.radius()[p];
    outside += radius > 0.0 ? 1u : 0u;
    // phi at markers is interpolated, to 0.01 h at this curvature.
    BOOST_REQUIRE(distance * std::copysign(1.0, radius) >= 0.09 * h);
    BOOST_REQUIRE(std::abs(distance) <= 3.01 * h);
    BOOST_REQUIRE(std::abs(std::abs(radius) - std::clamp(std::abs(distance), 0.1 * h, 0.5 * h)) <= 0.01 * h);
    BOOST_REQUIRE(!markers.escaped(p));
  }
  // Cells with a corner within 3 h: those whose middle is within 3 h and between half a side and half a diagonal.
  const double area = D == 2 ? 2.0 * std::numbers::pi * 0.2 : 4.0 * std::numbers::pi * 0.04;
  const double cells = area / std::pow(h, D - 1);
  const double wanted = D == 2 ? 16.0 : 64.0;
  BOOST_TEST(static_cast<double>(markers.size()) >= 6.9 * cells * wanted);
  BOOST_TEST(static_cast<double>(markers.size()) <= 8.0 * cells * wanted);
  BOOST_TEST(static_cast<double>(outside) >= 0.45 * static_cast<double>(markers.size()));
  BOOST_TEST(static_cast<double>(outside) <= 0.65 * static_cast<double>(markers.size()));
  // A second seeding fills cells that attraction left short, and empties the others; then all have their number.
  const std::size_t before = markers.size();
  markers.reseed(level_set.band(), {}, 1, Serial{});
  BOOST_TEST(static_cast<double>(markers.size()) >= 0.9 * static_cast<double>(before));
  BOOST_TEST(static_cast<double>(markers.size()) <= 1.1 * static_cast<double>(before));
}

namespace {

/// A base that forgets: it leaves phi as it is.
struct Resting {
  struct Params {};
  explicit Resting(const Params&) {}
  template <class L, class V, class E>
  void step(L&, V&&, double, double, const E&) {}
};

}  // namespace

// Markers that move by less than a spacing while phi rests must carry the interface: what they escape by is corrected
// to within the smallest radius.
BOOST_AUTO_TEST_CASE_TEMPLATE(markers_alone_carry_the_interface, Dim, Dimensions) {
  constexpr int D = Dim::value;
  const auto lattice = Lattice<D>::periodic_box(Box<D>::cube(), 32);
  const double h = lattice.spacing();
  LevelSet<ClosestPoint, D, double> level_set(lattice, Ball<D>{}, {}, Serial{});
  ParticleCorrected<Resting> advection({.reseed_every = 1});
  const Vec<D> u = Vec<D>::constant(0.6 * h / std::sqrt(static_cast<double>(D)));
  std::size_t escaped = 0;
  for (int k = 0; k < 3; ++k) {
    const auto report = advection.step(
        level_set, [&](const Vec<D>&, double) { return u; }, k, 1.0, Serial{});
    escaped += report.escaped;
    BOOST_TEST(report.reseeded);
    BOOST_TEST(report.dropped == 0u);
    BOOST_TEST(report.markers == advection.markers(lattice).size());
  }
  BOOST_TEST(escaped > 100u);
  const double left = interface_error(level_set, Ball<D>{Ball<D>{}.centre + 3.0 * u, Ball<D>{}.radius});
  BOOST_TEST_MESSAGE(D << "D carried to " << left / h << " h of a way of 1.8 h");
  BOOST_TEST(left <= 0.6 * h);
  BOOST_TEST(interface_error(level_set, Ball<D>{}) >= 1.2 * h);
}

// Threads, and scalars: a run in float differs from one in double by when markers escape, so only the size of what it
// does is held.
BOOST_AUTO_TEST_CASE(threads_and_scalars) {
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 64);
  const auto run = [&]<class T>(T, const auto& execution, std::size_t& escaped) {
    LevelSet<ClosestPoint, 2, T> disk(lattice, Ball<2>{{0.5, 0.75}, 0.15}, {}, execution);
    auto params = often;
    params.reseed_every = 8;
    Corrected advection(params);
    escaped = 0;
    for (int k = 0; k < 16; ++k) {
      escaped += advection.step(disk, Vortex<T>{2.0}, k / 16.0, 1.0 / 16.0, execution).escaped;
    }
    return disk;
  };
  std::size_t escaped = 0, again = 0;
  const auto one = run(double{}, OpenMP{1}, escaped);
  BOOST_TEST(escaped > 0u);
  for (const int threads : {2, 3}) {
    BOOST_TEST(same_bits(run(double{}, OpenMP{threads}, again).band(), one.band()));
    BOOST_TEST(again == escaped);
  }
  const auto floats = run(float{}, Serial{}, again);
  BOOST_TEST(again > 0u);
  BOOST_TEST(std::abs(enclosed(floats) / enclosed(one) - 1.0) <= 1e-3);
}

BOOST_AUTO_TEST_CASE(bad_input_is_named_and_leaves_markers) {
  BOOST_CHECK_THROW(Corrected({.substeps = 0}), ValueError);
  BOOST_CHECK_THROW(Corrected({.reseed_every = -1}), ValueError);
  BOOST_CHECK_THROW(Corrected({.markers = {.width = 5.0}}), ValueError);
  BOOST_CHECK_THROW(Corrected({.markers = {.smallest_radius = 0.0}}), ValueError);
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 64);
  LevelSet<ClosestPoint, 2, double> disk(lattice, Ball<2>{}, {}, Serial{});
  Corrected advection(often);
  advection.step(
      disk,
      [](const Vec<2>&, double) {
        return Vec<2>{0.01, 0.0};
      },
      0.0, 1.0);
  const auto before = disk.band();
  const std::size_t markers = advection.markers(lattice).size();
  const Vec<2> first = advection.markers(lattice).positions()[0];
  const auto nan = [](const Vec<2>&, double) { return Vec<2>{std::numeric_limits<double>::quiet_NaN(), 0.0}; };
  BOOST_CHECK_THROW(advection.step(disk, nan, 0.0, 1.0), PositionError);
  BOOST_TEST(same_bits(disk.band(), before));
  BOOST_TEST(advection.markers(lattice).size() == markers);
  BOOST_TEST((advection.markers(lattice).positions()[0] == first));
}
