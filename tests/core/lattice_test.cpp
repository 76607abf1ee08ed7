// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE lattice
#include <boost/test/unit_test.hpp>
#include <limits>
#include <string>
#include <tuple>

#include <cambium/core/lattice.hpp>

using namespace cambium;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

void refuses(const Box<2>& box, double spacing, const std::array<bool, 2>& periodic, const std::string& part) {
  BOOST_CHECK_EXCEPTION(Lattice<2>(box, spacing, periodic), LatticeError, [&](const Error& error) {
    BOOST_TEST_MESSAGE(error.what());
    return std::string(error.what()).find(part) != std::string::npos;
  });
}

template <int D>
struct Dim {
  static constexpr int dimension = D;
};
using Dims = std::tuple<Dim<1>, Dim<2>, Dim<3>>;

}  // namespace

BOOST_AUTO_TEST_CASE(periodic_axes_have_a_node_less_than_bounded_ones) {
  const Lattice<2> lattice({{-1.0, 0.0}, {1.0, 1.0}}, 0.25, {true, false});
  BOOST_TEST((lattice.nodes() == Index<2>{8, 5}));
  BOOST_TEST(lattice.size() == 40u);
  BOOST_TEST(lattice.cell_volume() == 0.0625);
  BOOST_TEST((lattice.position({0, 0}) == Vec<2>{-1.0, 0.0}));
  BOOST_TEST((lattice.position({7, 4}) == Vec<2>{0.75, 1.0}));
  BOOST_TEST((lattice.periodic(0) && !lattice.periodic(1)));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(numbers_and_nodes_are_inverse_with_axis_0_fastest, C, Dims) {
  constexpr int D = C::dimension;
  Box<D> box;
  std::array<bool, D> periodic{};
  for (int d = 0; d < D; ++d) {
    box.hi[d] = 1.0 + d;
    periodic[d] = d % 2 == 1;
  }
  const Lattice<D> lattice(box, 0.25, periodic);
  Index<D> node;
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    BOOST_TEST((lattice.node(i) == node));
    BOOST_TEST(lattice.number(node) == i);
    BOOST_TEST(lattice.contains(node));
    for (int d = 0; d < D && ++node[d] == lattice.nodes()[d]; ++d) node[d] = 0;
  }
}

BOOST_AUTO_TEST_CASE(wrapping_and_containing) {
  const Lattice<2> lattice(Box<2>::cube(), 0.25, {true, false});
  for (std::ptrdiff_t i = -9; i < 9; ++i) BOOST_TEST(lattice.wrap(0, i) == (i + 12) % 4);
  BOOST_TEST(lattice.wrap(1, -3) == -3);
  BOOST_TEST(!lattice.contains({4, 0}));
  BOOST_TEST(lattice.contains({3, 4}));
  BOOST_TEST(!lattice.contains({0, -1}));
}

BOOST_AUTO_TEST_CASE(spacings_that_are_no_binary_fractions) {
  for (std::ptrdiff_t n = 1; n < 3000; ++n) {
    const Lattice<1> by_count = Lattice<1>::bounded_box({{0.1}, {0.8}}, n);
    BOOST_TEST(by_count.nodes()[0] == n + 1);
    BOOST_TEST(by_count.position({n})[0] == 0.8);  // lo + n h is outside for one n in twenty
    const Lattice<1> by_spacing({{0.1}, {0.8}}, 0.7 / static_cast<double>(n), {true});
    BOOST_TEST(by_spacing.nodes()[0] == n);
  }
}

BOOST_AUTO_TEST_CASE(bad_input) {
  const Box<2> unit = Box<2>::cube();
  refuses(unit, 0.0, {}, "lattice spacing is 0: it must be a positive, finite length");
  refuses(unit, -0.1, {}, "lattice spacing is -0.1");
  refuses(unit, nan_value, {}, "lattice spacing is nan");
  refuses(unit, infinity, {}, "lattice spacing is inf");
  refuses(unit, 0.3, {true, true}, "period 1 along axis 0 is 3.33333333333333");
  refuses({{0.0, 0.0}, {0.6, 1.0}}, 0.3, {}, "extent 1 along axis 1 is 3.33333333333333");
  refuses(unit, 3.0, {}, "choose a spacing that divides it a whole number of times");
  refuses({{0.0, 1.0}, {1.0, 1.0}}, 0.5, {}, "box has extent 0 along axis 1 (from 1 to 1): it must be positive");
  refuses({{0.0, 1.0}, {1.0, 0.0}}, 0.5, {}, "box has extent -1 along axis 1");
  refuses({{0.0, nan_value}, {1.0, 1.0}}, 0.5, {}, "box has extent nan along axis 1");
  refuses({{0.0, 0.0}, {1.0, infinity}}, 0.5, {}, "box has extent inf along axis 1");
  refuses(unit, 1e-300, {}, "nodes along axis 0 is too large to be numbered: choose a larger spacing");
  refuses(unit, 1e-11, {}, "lattice of (100000000001, 100000000001) nodes is too large to be numbered");
  BOOST_CHECK_THROW(Lattice<2>::periodic_box(unit, 0), LatticeError);
  BOOST_CHECK_THROW(Lattice<2>::bounded_box(unit, -4), LatticeError);
}
