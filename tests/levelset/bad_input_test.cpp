// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE levelset_bad_input
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include <cambium/levelset.hpp>

#include "levelset/advection_scenes.hpp"
#include "support/meshes.hpp"

using namespace cambium;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <int N>
using Dimension = std::integral_constant<int, N>;
using Dimensions = std::tuple<Dimension<2>, Dimension<3>>;
using Reinitialisations = std::tuple<ClosestPoint, FastMarching<>, FastSweeping<>, GroupMarching<LinearKickOff>,
                                     PdeReinit<>, GradientNormalised, LagrangianReinit<>, UpwindLagrangianReinit<>>;

template <int D>
Lattice<D> lattice() {
  return Lattice<D>::bounded_box(Box<D>::cube(), 32);
}

template <int D>
using Flow = std::function<Vec<D>(const Vec<D>&, double)>;

/// Bits of all values, NaN included.
template <int D>
std::vector<std::vector<double>> values(const NarrowBand<double, D>& band) {
  std::vector<std::vector<double>> result;
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    result.emplace_back(band.values().block(b).begin(), band.values().block(b).end());
    for (double& phi : result.back()) phi = std::isnan(phi) ? 1e300 : phi;
  }
  return result;
}

template <class E>
auto says(const std::string& text) {
  return [text](const E& error) { return std::string(error.what()).find(text) != std::string::npos; };
}

/// f() throws an E that says `text`, and the level set is as before to the last bit.
template <class E, class L, class F>
void check_unchanged(const L& level_set, const std::string& text, F&& f) {
  const auto before = level_set.band();
  BOOST_CHECK_EXCEPTION(f(), E, says<E>(text));
  BOOST_TEST(advection_scenes::same_bits(before, level_set.band()));
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(no_zero_crossing, Dim, Dimensions) {
  constexpr int D = Dim::value;
  using Set = LevelSet<ClosestPoint, D>;
  for (const double value : {1.0, -1.0}) {
    BOOST_CHECK_EXCEPTION(Set(lattice<D>(), [=](const Vec<D>&) { return value; }), InterfaceError,
                          says<InterfaceError>("no zero crossing"));
  }
  // A ball smaller than a cell, between the nodes, is not seen.
  BOOST_CHECK_THROW(Set(lattice<D>(), Ball<D>(Vec<D>::constant(0.5 + 0.5 / 32), 0.2 / 32)), InterfaceError);
}

// A ball whose surface moves inwards further than to its middle.
BOOST_AUTO_TEST_CASE(an_interface_that_vanishes) {
  const Vec<2> middle = Vec<2>::constant(0.51);
  LevelSet<ClosestPoint, 2> level_set(lattice<2>(), Ball<2>(middle, 0.06));
  const Flow<2> inwards = [=](const Vec<2>& x, double) { return (middle - x) / std::max(norm(middle - x), 1e-3); };
  check_unchanged<InterfaceError>(level_set, "vanished", [&] { Backward<>().step(level_set, inwards, 0.0, 0.1); });
}

BOOST_AUTO_TEST_CASE(an_interface_at_the_wall) {
  BOOST_CHECK_EXCEPTION((LevelSet<ClosestPoint, 2>(lattice<2>(), Ball<2>(Vec<2>::constant(0.5), 0.45))), InterfaceError,
                        says<InterfaceError>("enlarge the box"));
  LevelSet<ClosestPoint, 2> level_set(lattice<2>(), Ball<2>(Vec<2>::constant(0.5), 0.2));
  const Flow<2> away = [](const Vec<2>&, double) { return Vec<2>::unit(0); };
  const std::string text = "enlarge the box";
  check_unchanged<InterfaceError>(level_set, text, [&] { Backward<>().step(level_set, away, 0.0, 0.25); });
  check_unchanged<InterfaceError>(level_set, text, [&] { Eulerian<>().step(level_set, away, 0.0, 0.25); });
  check_unchanged<PositionError>(level_set, text, [&] { Lagrangian<>().step(level_set, away, 0.0, 0.25); });
}

BOOST_AUTO_TEST_CASE(a_band_that_is_too_thin) {
  using Set = LevelSet<ClosestPoint, 2>;
  const Ball<2> ball({0.5, 0.5}, 0.2);
  for (const double width : {4.9, 0.0, -1.0, not_a_number}) {
    BOOST_CHECK_THROW(Set(lattice<2>(), ball, {.half_width = width, .reinit = {}}), ValueError);
  }
  BOOST_CHECK_EXCEPTION(Set(lattice<2>(), ball, {.half_width = 4.9, .reinit = {}}), ValueError,
                        says<ValueError>("choose a wider band"));
  LevelSet<FastMarching<>, 2> thin(lattice<2>(), ball, {.half_width = 3.2, .reinit = {}});
  const Flow<2> still = [](const Vec<2>&, double) { return Vec<2>{}; };
  check_unchanged<ValueError>(thin, "widen it", [&] { Eulerian<>().step(thin, still, 0.0, 1.0); });
}

BOOST_AUTO_TEST_CASE_TEMPLATE(values_that_are_not_finite, Reinit, Reinitialisations) {
  LevelSet<ClosestPoint, 2> level_set(lattice<2>(), Ball<2>({0.5, 0.5}, 0.2));
  for (const double bad : {not_a_number, std::numeric_limits<double>::infinity()}) {
    NarrowBand<double, 2> band = level_set.band();
    band.values().set({23, 16}, bad);
    const auto before = values(band);
    typename Reinit::template Method<double, 2> method{typename Reinit::Params{}};
    BOOST_CHECK_THROW(method(band, Serial{}), ValueError);
    BOOST_TEST((values(band) == before));
  }
}

BOOST_AUTO_TEST_CASE(shapes_that_are_not_finite) {
  for (const double bad : {not_a_number, std::numeric_limits<double>::infinity()}) {
    BOOST_CHECK_THROW((LevelSet<ClosestPoint, 2>(lattice<2>(), [=](const Vec<2>&) { return bad; })), ValueError);
  }
}

BOOST_AUTO_TEST_CASE(velocities_that_are_not_finite) {
  LevelSet<ClosestPoint, 2> level_set(lattice<2>(), Ball<2>(Vec<2>::constant(0.5), 0.2));
  const Flow<2> nowhere = [](const Vec<2>& x, double) { return Vec<2>::constant(x[0] > 0.6 ? not_a_number : 0.1); };
  check_unchanged<Error>(level_set, "velocity", [&] { Backward<>().step(level_set, nowhere, 0.0, 0.1); });
  check_unchanged<Error>(level_set, "", [&] { Lagrangian<>().step(level_set, nowhere, 0.0, 0.1); });
  check_unchanged<Error>(level_set, "", [&] { Eulerian<>().step(level_set, nowhere, 0.0, 0.1); });
}

BOOST_AUTO_TEST_CASE(a_mesh_with_a_hole) {
  TriangleMesh mesh = support::box_mesh(Box<3>::cube());
  mesh.facets.pop_back();
  BOOST_CHECK_EXCEPTION(MeshShape<3>{mesh}, MeshError, says<MeshError>("not closed"));
}

BOOST_AUTO_TEST_CASE(an_image_without_foreground) {
  const std::vector<int> labels(lattice<2>().size(), 3);
  BOOST_CHECK_EXCEPTION(shape_from_labels(lattice<2>(), labels, 4), InterfaceError,
                        says<InterfaceError>("no foreground"));
}
