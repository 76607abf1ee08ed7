// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE cell_grid
#include <boost/test/unit_test.hpp>
#include <limits>
#include <string>

#include <cambium/particles/cell_grid.hpp>

using namespace cambium;

namespace {

template <class Error, class F>
void refuses(F&& f, const std::string& part) {
  BOOST_CHECK_EXCEPTION(f(), Error, [&](const cambium::Error& error) {
    BOOST_TEST_MESSAGE(error.what());
    return std::string(error.what()).find(part) != std::string::npos;
  });
}

}  // namespace

BOOST_AUTO_TEST_CASE(cells_cover_the_box_and_are_at_most_the_size_asked_for) {
  const Domain<2> domain = Domain<2>::bounded_box({{0.0, 0.0}, {1.0, 0.35}});
  const CellGrid<2> tenths(domain, 0.1);
  BOOST_TEST((tenths.cells() == Index<2>{10, 4}));  // 1/0.1 is not 11 cells by round-off
  BOOST_TEST(tenths.size() == 40u);
  BOOST_TEST(tenths.edge()[1] == 0.35 / 4);
  BOOST_TEST((CellGrid<2>(domain, 5.0).cells() == Index<2>{1, 1}));
}

BOOST_AUTO_TEST_CASE(cells_and_rows_of_a_lattice) {
  const Lattice<3> lattice({{0.0, 0.0, 0.0}, {1.0, 0.5, 2.0}}, 0.25, {false, true, false});
  BOOST_TEST((CellGrid<3>::cells_of(lattice).cells() == Index<3>{4, 2, 8}));
  BOOST_TEST((CellGrid<3>::rows_of(lattice).cells() == Index<3>{1, 2, 8}));
  BOOST_TEST((CellGrid<3>::cells_of(lattice).edge() == Vec<3>::constant(0.25)));
}

BOOST_AUTO_TEST_CASE(faces_and_periods) {
  const Domain<2> domain{{{-1.0, 0.0}, {1.0, 1.0}}, {false, true}};
  const CellGrid<2> grid(domain, Index<2>{4, 5});
  BOOST_TEST(grid.number(Vec<2>{-1.0, 0.0}) == 0u);
  BOOST_TEST(grid.number(Vec<2>{1.0, 0.0}) == 3u);   // the upper face of a bounded axis
  BOOST_TEST(grid.number(Vec<2>{-1.0, 1.0}) == 0u);  // that of a periodic one is the lower face
  BOOST_TEST(grid.number(Vec<2>{0.1, 7.5}) == 2u + 4u * 2u);
  BOOST_TEST(grid.number(Vec<2>{0.1, -0.1}) == 2u + 4u * 4u);
  BOOST_TEST(grid.number(Vec<2>{0.1, -1e-300}) == 2u);  // wraps onto the lower face by round-off
  BOOST_TEST(grid.number(Vec<2, float>{0.1f, 7.5f}) == 2u + 4u * 2u);
}

BOOST_AUTO_TEST_CASE(bad_input) {
  const Domain<2> domain = Domain<2>::bounded_box(Box<2>::cube());
  refuses<ValueError>([&] { CellGrid<2>(domain, 0.0); }, "cell size is 0: it must be a positive, finite length");
  refuses<ValueError>([&] { CellGrid<2>(domain, std::numeric_limits<double>::quiet_NaN()); }, "cell size is nan");
  refuses<LatticeError>([&] { CellGrid<2>(domain, 1e-6); }, "choose larger cells");
  refuses<LatticeError>([&] { CellGrid<2>(domain, Index<2>{3, 0}); }, "0 cells along axis 1");
  refuses<LatticeError>([] { CellGrid<2>(Domain<2>{}, 0.1); }, "box has extent 0 along axis 0");
}
