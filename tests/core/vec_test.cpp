// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE vec
#include <boost/test/unit_test.hpp>
#include <sstream>

#include <cambium/core/vec.hpp>

using namespace cambium;

// Everything but norm() is a constant expression.
static_assert(Vec<3>{1.0, 2.0, 3.0} + Vec<3>{1.0, 1.0, 1.0} == Vec<3>{2.0, 3.0, 4.0});
static_assert(Vec<2>{1.0, 2.0} - Vec<2>{3.0, 5.0} == Vec<2>{-2.0, -3.0});
static_assert(-Vec<2>{1.0, -2.0} == Vec<2>{-1.0, 2.0});
static_assert(2.0 * Vec<2>{1.0, 2.0} == Vec<2>{1.0, 2.0} * 2.0);
static_assert(Vec<2>{1.0, 2.0} / 4.0 == Vec<2>{0.25, 0.5});
static_assert(Vec<2>{1.0, 2.0} != Vec<2>{1.0, 2.5});
static_assert(Vec<3>{} == Vec<3>::constant(0.0));
static_assert(Vec<3>::unit(1) == Vec<3>{0.0, 1.0, 0.0});
static_assert(Vec<3>::unit(2, -0.5) == Vec<3>{0.0, 0.0, -0.5});
static_assert(dot(Vec<3>{1.0, 2.0, 3.0}, Vec<3>{4.0, -5.0, 6.0}) == 12.0);
static_assert(product(Index<3>{2, 3, 4}) == 24);
static_assert(-Index<2>{1, -2} == Index<2>{-1, 2});

static_assert(is_vec<Vec<2, float>> && !is_vec<double>);
static_assert(Components<double>::count == 1 && Components<Vec<4, float>>::count == 4);
static_assert(std::is_same_v<ScalarOf<Vec<4, float>>, float> && std::is_same_v<ScalarOf<double>, double>);

BOOST_AUTO_TEST_CASE(compound_assignment) {
  Vec<2> v{1.0, 2.0};
  v += {1.0, 1.0};
  v *= 3.0;
  v -= {1.0, 1.0};
  v /= 2.0;
  BOOST_TEST((v == Vec<2>{2.5, 4.0}));
  v[1] = 7.0;
  BOOST_TEST(v[1] == 7.0);
}

BOOST_AUTO_TEST_CASE(length) {
  BOOST_TEST(norm(Vec<2>{3.0, 4.0}) == 5.0);
  BOOST_TEST(norm(Vec<3, float>{2.0f, 3.0f, 6.0f}) == 7.0f);
}

BOOST_AUTO_TEST_CASE(components_of_scalars_and_vectors) {
  double scalar = 1.0;
  Vec<3> vector{1.0, 2.0, 3.0};
  component(scalar, 0) = 4.0;
  component(vector, 2) = 5.0;
  BOOST_TEST(scalar == 4.0);
  BOOST_TEST((vector == Vec<3>{1.0, 2.0, 5.0}));
  const Vec<3>& view = vector;
  BOOST_TEST(component(view, 1) == 2.0);
}

BOOST_AUTO_TEST_CASE(printing) {
  std::ostringstream out;
  out << Vec<3>{1.0, -0.5, 2.0} << Index<1>{7};
  BOOST_TEST(out.str() == "(1, -0.5, 2)(7)");
}
