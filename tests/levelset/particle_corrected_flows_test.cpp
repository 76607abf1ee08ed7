// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE levelset_particle_corrected_flows
#include <boost/test/unit_test.hpp>
#include <numbers>

#include <cambium/levelset/advection/lagrangian.hpp>
#include <cambium/levelset/advection/particle_corrected.hpp>
#include <cambium/levelset/reinit/pde_reinit.hpp>

#include "levelset/advection_scenes.hpp"

using namespace cambium;
using namespace advection_scenes;

namespace {

/// A base that is made to err: remeshing by M4' followed, every step, by a reinitialisation that moves the interface.
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
  LevelSet<PdeReinit<>, 2, double> level_set(lattice, shape, {}, Serial{});
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

// One turn of Zalesak's disk in 64 steps, in a box large enough for the band to turn in.
BOOST_AUTO_TEST_CASE(zalesaks_disk_keeps_its_corners) {
  const Lattice<2> lattice(Box<2>{{-10.0, -10.0}, {110.0, 110.0}}, 1.0, {false, false});
  const double perimeter = 30.0 * std::numbers::pi - 5.0 + 50.0;
  const Result base = advance(lattice, SlottedDisk{}, perimeter, Rotation<2>{50.0}, 1.0, 64, false);
  const Result both = advance(lattice, SlottedDisk{}, perimeter, Rotation<2>{50.0}, 1.0, 64, true);
  BOOST_TEST_MESSAGE("slotted disk: base " << base.difference << " h " << base.area << ", corrected " << both.difference
                                           << " h " << both.area);
  BOOST_TEST(both.difference < 0.6 * base.difference);
  BOOST_TEST(std::abs(both.area) < 0.002);  // 0.0009; the base fills the slot as much as it cuts corners
  BOOST_TEST(both.difference < 0.12);
}

BOOST_AUTO_TEST_CASE(a_vortex_loses_less) {
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 64);
  const Ball<2> disk{{0.5, 0.75}, 0.15};
  const double perimeter = 0.3 * std::numbers::pi;
  const Result base = advance(lattice, disk, perimeter, Vortex<double>{2.0}, 2.0, 64, false);
  const Result both = advance(lattice, disk, perimeter, Vortex<double>{2.0}, 2.0, 64, true);
  BOOST_TEST_MESSAGE("vortex: base " << base.difference << " h " << base.area << ", corrected " << both.difference
                                     << " h " << both.area);
  BOOST_TEST(both.difference < 0.5 * base.difference);
  BOOST_TEST(std::abs(both.area) < 0.75 * std::abs(base.area));
}

// Threads, and scalars: a run in float differs from one in double by when markers escape, so only the size of what it
// does is held.
BOOST_AUTO_TEST_CASE(threads_and_scalars) {
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 64);
  const auto run = [&]<class T>(T, const auto& execution, std::size_t& escaped) {
    LevelSet<PdeReinit<>, 2, T> disk(lattice, Ball<2>{{0.5, 0.75}, 0.15}, {}, execution);
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
