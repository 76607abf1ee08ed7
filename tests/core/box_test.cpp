// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE box
#include <boost/test/unit_test.hpp>
#include <limits>

#include <cambium/core/box.hpp>

using namespace cambium;

static_assert(Box<3>::cube(2.0).extent() == Vec<3>::constant(2.0));
static_assert(Box<3>::cube(2.0).volume() == 8.0);
static_assert(Box<2>{{-1.0, 0.0}, {3.0, 1.0}}.centre() == Vec<2>{1.0, 0.5});
static_assert(Box<2>{{-1.0, 0.0}, {3.0, 1.0}}.volume() == 4.0);
static_assert(Box<2>::cube() == Box<2>{{0.0, 0.0}, {1.0, 1.0}});

BOOST_AUTO_TEST_CASE(faces_belong_to_the_box_and_nan_does_not) {
  const Box<2> box{{-1.0, 0.0}, {3.0, 1.0}};
  BOOST_TEST(box.contains({0.0, 0.5}));
  BOOST_TEST(box.contains({-1.0, 0.0}));
  BOOST_TEST(box.contains({3.0, 1.0}));
  BOOST_TEST(!box.contains({3.0 + 1e-15, 1.0}));
  BOOST_TEST(!box.contains({0.0, -1e-300}));
  BOOST_TEST(!box.contains({0.0, std::numeric_limits<double>::quiet_NaN()}));
}
