// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE levelset_particle_corrected
#include <boost/test/unit_test.hpp>
#include <limits>
#include <tuple>

#include <cambium/levelset/advection/particle_corrected.hpp>

#include "levelset/advection_scenes.hpp"

using namespace cambium;
using namespace advection_scenes;

using Dimensions = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
using Corrected = ParticleCorrected<>;

namespace {

/// A base that errs by a known amount: it moves the interface inwards by 0.8 spacings, or outwards if so asked.
struct Shifting {
  struct Params {
    double by = 0.8;
  };
  explicit Shifting(const Params& params) : by(params.by) {}
  template <class L, class V, class E>
  void step(L& level_set, V&&, double, double, const E& execution) {
    const auto old = level_set.band();
    level_set.replace(
        [&](auto& marks) {
          for (std::size_t b = 0; b < old.blocks(); ++b) {
            marks.mark(old.values().block_origin(b), old.values().block_origin(b));
          }
        },
        [&](auto& band, std::size_t b, std::size_t) {
          const auto from = static_cast<std::size_t>(old.values().find(band.values().block_index(b)));
          for (std::size_t i = 0; i < band.volume; ++i) {
            band.values().block(b)[i] = old.values().block(from)[i] + by * old.spacing();
          }
          return true;
        },
        execution);
  }
  double by;
};

}  // namespace

// Balls touch the interface from their side: so what they correct goes towards where the interface was, and nowhere
// beyond it but by the error of phi at markers (0.01 h), and the mean of what is left is a small part.
BOOST_AUTO_TEST_CASE_TEMPLATE(markers_mend_what_the_base_loses, Dim, Dimensions) {
  constexpr int D = Dim::value;
  const auto lattice = Lattice<D>::periodic_box(Box<D>::cube(), 32);
  const double h = lattice.spacing();
  for (const double by : {0.8, -0.8}) {
    LevelSet<ClosestPoint, D, double> level_set(lattice, Ball<D>{}, {}, Serial{});
    ParticleCorrected<Shifting> advection({.base = {by}, .reinitialise_every = 0, .reseed_every = 1});
    const auto before = level_set.band();
    const auto report = advection.step(
        level_set, [](const Vec<D>&, double) { return Vec<D>{}; }, 0.0, 1.0, Serial{});
    BOOST_TEST(report.escaped > 100u);
    BOOST_TEST(report.reseeded);
    BOOST_TEST(report.dropped == 0u);
    BOOST_TEST(report.markers == advection.markers(lattice).size());
    double left = 0.0, nodes = 0.0;
    for_each_band_node(level_set.band(), [&](const Index<D>& node, double phi) {
      const double error = (phi - before(node)) / by;
      if (std::abs(before(node)) > 0.4 * h) return;
      BOOST_REQUIRE(error >= -0.02 * h);
      BOOST_REQUIRE(error <= 1.0001 * h);
      left += error / h;
      nodes += 1.0;
    });
    BOOST_TEST_MESSAGE(D << "D, " << by << ": of an error of 1, left in the mean " << left / nodes);
    BOOST_TEST(left / nodes <= 0.5);
  }
}

BOOST_AUTO_TEST_CASE(bad_input_is_named_and_leaves_markers) {
  BOOST_CHECK_THROW(Corrected({.substeps = 0}), ValueError);
  BOOST_CHECK_THROW(Corrected({.reseed_every = -1}), ValueError);
  BOOST_CHECK_THROW(Corrected({.markers = {.width = 5.0}}), ValueError);
  BOOST_CHECK_THROW(Corrected({.markers = {.smallest_radius = 0.0}}), ValueError);
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 64);
  LevelSet<ClosestPoint, 2, double> disk(lattice, Ball<2>{}, {}, Serial{});
  Corrected advection;
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
