// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE levelset_markers
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

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
  // Cells with a corner within 3 h: their middles lie within 3 h and half the width of a cell across the interface, on
  // average 2 / pi in 2D and 3 / 4 in 3D. No marker is lost: those in the cells further than 3 h are drawn nearer.
  const double reach = (3.0 + (D == 2 ? 2.0 / std::numbers::pi : 0.75)) * h;
  const double unit = (D == 2 ? std::numbers::pi : 4.0 / 3.0 * std::numbers::pi) / lattice.cell_volume();
  const double wanted = D == 2 ? 16.0 : 64.0;
  const double expected_outside = wanted * unit * (std::pow(0.2 + reach, D) - std::pow(0.2, D));
  const double expected_inside = wanted * unit * (std::pow(0.2, D) - std::pow(0.2 - reach, D));
  const auto inside = static_cast<double>(markers.size() - outside);
  BOOST_TEST_MESSAGE(D << "D: " << static_cast<double>(outside) / expected_outside - 1.0 << " "
                       << inside / expected_inside - 1.0);
  BOOST_TEST(std::abs(static_cast<double>(outside) / expected_outside - 1.0) <= 0.05);
  BOOST_TEST(std::abs(inside / expected_inside - 1.0) <= 0.05);
  // A second seeding thins out the cells that attraction filled, keeping most markers as they are, and fills the
  // others: markers stay near their number.
  const std::size_t before = markers.size();
  std::vector<double> abscissae(markers.positions().column(0).begin(), markers.positions().column(0).end());
  std::ranges::sort(abscissae);
  markers.read(level_set.band(), Serial{});
  markers.reseed(level_set.band(), {}, 1, Serial{});
  BOOST_TEST(static_cast<double>(markers.size()) >= 0.9 * static_cast<double>(before));
  BOOST_TEST(static_cast<double>(markers.size()) <= 1.1 * static_cast<double>(before));
  double kept = 0.0;
  for (const double x : markers.positions().column(0)) kept += std::ranges::binary_search(abscissae, x) ? 1.0 : 0.0;
  BOOST_TEST_MESSAGE("kept " << kept / static_cast<double>(before));
  BOOST_TEST(kept >= 0.6 * static_cast<double>(before));
  BOOST_TEST(kept < static_cast<double>(before));
}
