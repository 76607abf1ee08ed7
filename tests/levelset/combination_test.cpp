// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#define BOOST_TEST_MODULE levelset_combination
#include <boost/test/unit_test.hpp>
#include <support/surface_samples.hpp>
#include <tuple>

#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/levelset/shapes/combination.hpp>
#include <cambium/levelset/shapes/cuboid.hpp>
#include <cambium/levelset/shapes/half_space.hpp>
#include <cambium/levelset/shapes/motion.hpp>

using namespace cambium;

namespace {

using Dimensions = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

template <int D>
Box<D> scene() {
  return {Vec<D>::constant(-1.0), Vec<D>::constant(1.0)};
}

/// The greatest slope between random pairs of near points.
template <Shape S>
double steepest(const S& shape) {
  constexpr int D = S::dimension;
  double slope = 0.0;
  for (const auto& x : support::random_points(scene<D>(), 2000)) {
    for (int d = 0; d < D; ++d) slope = std::max(slope, std::abs(shape(x + Vec<D>::unit(d, 1e-4)) - shape(x)) / 1e-4);
  }
  return slope;
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(signs_follow_the_rule, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  const Ball<D> a(Vec<D>::constant(0.1), 0.5);
  const Ball<D> b(Vec<D>::constant(-0.2), 0.4);
  const Cuboid<D> c(Box<D>{Vec<D>::constant(-0.2), Vec<D>::constant(0.6)});
  const auto all = unite(a, b, c);
  const auto common = intersect(a, b, c);
  const auto rest = subtract(a, b);
  check_shape<decltype(all)>();
  int wrong = 0, in_common = 0, in_rest = 0;
  for (const auto& x : support::random_points(scene<D>(), 10000)) {
    const bool in_a = a(x) < 0.0, in_b = b(x) < 0.0, in_c = c(x) < 0.0;
    wrong += (all(x) < 0.0) != (in_a || in_b || in_c);
    wrong += (common(x) < 0.0) != (in_a && in_b && in_c);
    wrong += (rest(x) < 0.0) != (in_a && !in_b);
    wrong += all(x) < 0.0 && !all.bounds().contains(x);
    wrong += common(x) < 0.0 && !common.bounds().contains(x);
    in_common += common(x) < 0.0;
    in_rest += rest(x) < 0.0;
  }
  BOOST_TEST(wrong == 0);
  BOOST_TEST(in_common > 10);
  BOOST_TEST(in_rest > 10);
  BOOST_TEST(steepest(all) <= 1.0 + 1e-9);
  BOOST_TEST(steepest(rest) <= 1.0 + 1e-9);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(blend_holds_the_union_and_fills_creases_only, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  const double length = 0.2;
  const Ball<D> a(Vec<D>::unit(0, -0.3), 0.4);
  const Ball<D> b(Vec<D>::unit(0, 0.3), 0.4);
  const auto soft = blend(a, b, length);
  const auto hard = unite(a, b);
  int wrong = 0, filled = 0;
  for (const auto& x : support::random_points(scene<D>(), 4000)) {
    wrong += soft(x) > hard(x) || soft(x) < hard(x) - length / 6.0 - 1e-15;
    wrong += std::abs(a(x) - b(x)) >= length && soft(x) != hard(x);
    wrong += soft(x) < 0.0 && !soft.bounds().contains(x);
    filled += soft(x) < 0.0 && hard(x) >= 0.0;
  }
  BOOST_TEST(wrong == 0);
  BOOST_TEST(filled > 0);
  BOOST_TEST(steepest(soft) <= 1.0 + 1e-9);
  // Two continuous derivatives across a = b, where the union has a jump of the first.
  const Vec<D> crease = Vec<D>::unit(1, 0.3);
  const double h = 1e-4;
  const auto second = [&](const auto& shape, double at) {
    const auto f = [&](double s) { return shape(crease + Vec<D>::unit(0, s)); };
    return (f(at + h) - 2.0 * f(at) + f(at - h)) / (h * h);
  };
  BOOST_TEST(std::abs(second(soft, 0.0) - second(soft, 0.003)) < 0.5);
  BOOST_TEST(std::abs(second(hard, 0.0)) > 1e3);
  BOOST_CHECK_THROW(blend(a, b, 0.0), ValueError);
}

BOOST_AUTO_TEST_CASE(rotation_and_shift_move_the_shape) {
  const Cuboid<2> flat(Box<2>{{0.1, 0.2}, {0.5, 0.3}});
  const Vec<2> centre{0.1, 0.2};
  const auto turned = rotate(flat, std::numbers::pi / 2.0, centre);
  const auto expected = Cuboid<2>(Box<2>{{0.0, 0.2}, {0.1, 0.6}});
  const auto shifted = translate(flat, {0.3, -0.1});
  check_shape<decltype(turned)>();
  for (const auto& x : support::random_points(scene<2>(), 500)) {
    BOOST_TEST(std::abs(turned(x) - expected(x)) < 1e-14);
    BOOST_TEST(std::abs(shifted(x) - flat(x - Vec<2>{0.3, -0.1})) < 1e-14);
  }
  for (int d = 0; d < 2; ++d) {
    BOOST_TEST(std::abs(turned.bounds().lo[d] - expected.bounds().lo[d]) < 1e-14);
    BOOST_TEST(std::abs(turned.bounds().hi[d] - expected.bounds().hi[d]) < 1e-14);
  }
  // A third of a turn around the diagonal takes axis 0 to axis 1 to axis 2.
  const Cuboid<3> block(Box<3>{{0.1, 0.2, 0.3}, {0.2, 0.5, 0.9}});
  const auto third = rotate(block, {1.0, 1.0, 1.0}, 2.0 * std::numbers::pi / 3.0, {0.2, 0.2, 0.2});
  for (const auto& x : support::random_points(scene<3>(), 500)) {
    BOOST_TEST(std::abs(third(x) - block({x[1], x[2], x[0]})) < 1e-14);
    if (third(x) < 0.0) BOOST_TEST(third.bounds().contains(x));
  }
  const auto half_space = translate(HalfSpace<3>({}, {1.0, 0.0, 0.0}), {0.0, 1.0, 0.0});
  BOOST_TEST(std::isinf(half_space.bounds().lo[2]));
  BOOST_CHECK_THROW(rotate(block, {}, 1.0, {}), ValueError);
  BOOST_CHECK_THROW(rotate(flat, std::nan(""), {}), ValueError);
  BOOST_CHECK_THROW(translate(flat, {std::nan(""), 0.0}), ValueError);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(images_make_a_shape_periodic, Dimension, Dimensions) {
  constexpr int D = Dimension::value;
  Domain<D> domain = Domain<D>::periodic_box(Box<D>::cube(1.0));
  domain.periodic[D - 1] = false;
  const Vec<D> centre = Vec<D>::constant(0.05);
  const auto shape = repeat(Ball<D>(centre, 0.2), domain);
  check_shape<decltype(shape)>();
  for (const auto& x : support::random_points(Box<D>::cube(1.0), 1000)) {
    BOOST_TEST(std::abs(shape(x) - (norm(domain.difference(centre, x)) - 0.2)) < 1e-14);
  }
}
