// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE levelset_markers
#include <boost/test/unit_test.hpp>
#include <numbers>
#include <tuple>
#include <utility>

#include <cambium/levelset/advection/markers.hpp>

#include "levelset/advection_scenes.hpp"

using namespace cambium;
using namespace advection_scenes;

using Dimensions = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

// What the rules of seeding promise, in 2D and 3D: every marker is on its side, within the width of the interface, and
// a ball that does not reach across it; on average as many in a cell as were asked for.
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
  // Cells with a corner within 3 h: their middles lie in shells of half width 3 h and between 0 and half a diagonal.
  const auto shell = [&](double w) { return std::pow(0.2 + w * h, D) - std::pow(0.2 - w * h, D); };
  const double unit = D == 2 ? std::numbers::pi : 4.0 / 3.0 * std::numbers::pi;
  const double wanted = D == 2 ? 16.0 : 64.0;
  const double diagonal = 0.5 * std::sqrt(static_cast<double>(D));
  const double density = static_cast<double>(markers.size()) / wanted * lattice.cell_volume();
  BOOST_TEST(density >= unit * shell(3.0));
  BOOST_TEST(density <= unit * shell(3.0 + diagonal));
  const double outer = (std::pow(0.2 + 3.4 * h, D) - std::pow(0.2, D)) / shell(3.4);
  BOOST_TEST(std::abs(static_cast<double>(outside) / static_cast<double>(markers.size()) - outer) <= 0.03);
  // A second seeding fills cells that attraction left short, and empties the others; then all have their number.
  const std::size_t before = markers.size();
  markers.reseed(level_set.band(), {}, 1, Serial{});
  BOOST_TEST(static_cast<double>(markers.size()) >= 0.9 * static_cast<double>(before));
  BOOST_TEST(static_cast<double>(markers.size()) <= 1.1 * static_cast<double>(before));
}
