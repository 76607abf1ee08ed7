// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE level_set
#include <boost/test/unit_test.hpp>
#include <string>

#include <cambium/levelset.hpp>

#include "levelset_scenes.hpp"

using namespace cambium;
using scenes::Ball;

namespace {

const Lattice<2> square = Lattice<2>::bounded_box(Box<2>::cube(), 48);

template <class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

BOOST_AUTO_TEST_CASE(far_nodes_read_as_the_half_width_of_their_side) {
  const LevelSet<ClosestPoint, 2> level_set(square, Ball<2>{});
  const double far = 6.0 / 48.0;
  BOOST_TEST(level_set.band()({24, 24}) == -far);
  BOOST_TEST(level_set.band()({0, 0}) == far);
  BOOST_TEST(level_set.band()({48, 48}) == far);
}

// A shell: inside, outside, inside again; every region far from the interface has its side.
BOOST_AUTO_TEST_CASE(sides_are_found_region_by_region) {
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 256);
  const auto shell = [](const Vec<2>& x) { return std::abs(norm(x - Vec<2>{0.5, 0.5}) - 0.3) - 0.1; };
  const LevelSet<ClosestPoint, 2> level_set(lattice, shell);
  for (std::ptrdiff_t j = 0; j <= 256; j += 4) {
    for (std::ptrdiff_t i = 0; i <= 256; i += 4) {
      const Index<2> node{i, j};
      BOOST_REQUIRE((level_set.band()(node) < 0.0) == (shell(lattice.position(node)) < 0.0));
    }
  }
}

BOOST_AUTO_TEST_CASE(dense_storage_has_every_node) {
  const LevelSet<ClosestPoint, 2, float, Dense> dense(square, Ball<2>{});
  const LevelSet<ClosestPoint, 2, float> sparse(square, Ball<2>{});
  for (std::size_t i = 0; i < square.size(); ++i) BOOST_REQUIRE(dense.phi()[i] == sparse.band()(square.node(i)));
}

// Sixteen times the nodes of a sphere's box, four times the blocks of its band.
BOOST_AUTO_TEST_CASE(memory_grows_with_the_area) {
  const auto blocks = [](std::ptrdiff_t cells) {
    return LevelSet<ClosestPoint, 3>(Lattice<3>::bounded_box(Box<3>::cube(), cells), Ball<3>{}).band().blocks();
  };
  const auto coarse = blocks(64);
  const auto fine = blocks(128);
  BOOST_TEST(fine < 5 * coarse);
}

BOOST_AUTO_TEST_CASE(bad_input_is_named) {
  using Set = LevelSet<ClosestPoint, 2>;
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  BOOST_TEST(has(message_of([] { Set(square, Ball<2>{.radius = -1.0}); }), "no zero crossing"));
  BOOST_TEST(has(message_of([] { Set(square, Ball<2>{.radius = 0.48}); }), "on a face of the box, across axis"));
  BOOST_TEST(has(message_of([] { Set(square, Ball<2>{}, {.half_width = 3.0, .reinit = {}}); }), "wider band"));
  BOOST_TEST(has(message_of([] { Set(square, Ball<2>{}, {.half_width = -3.0, .reinit = {}}); }), "half width"));
  BOOST_TEST(has(message_of([] { Set(square, [](const Vec<2>&) { return std::nan(""); }); }), "not finite"));
}
