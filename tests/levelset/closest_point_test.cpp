// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE closest_point
#include <boost/test/unit_test.hpp>
#include <tuple>
#include <vector>

#include <cambium/kernels.hpp>
#include <cambium/levelset.hpp>

#include "levelset_scenes.hpp"
#include "support/order.hpp"

using namespace cambium;
using scenes::distance_error;
using scenes::Sphere;

namespace {

template <int D, class R>
struct Case {
  using Reinit = R;
  static constexpr int dimension = D;
};
using Cases = std::tuple<Case<2, ClosestPoint>, Case<3, ClosestPoint>, Case<2, BasicClosestPoint<M4Prime>>,
                         Case<3, BasicClosestPoint<M4Prime>>, Case<2, BasicClosestPoint<M6>>>;
template <class R>
constexpr int order = 5;
template <>
constexpr int order<BasicClosestPoint<M4Prime>> = 3;

template <int D>
Lattice<D> lattice(std::ptrdiff_t cells) {
  return Lattice<D>::bounded_box(Box<D>::cube(), cells);
}
}  // namespace

// The error of the interpolant's zero set, h^(p + 1), everywhere in the band: closest points propagate, errors do not.
BOOST_AUTO_TEST_CASE_TEMPLATE(distance_from_bad_scaling_has_the_order_of_the_kernel, C, Cases) {
  constexpr int D = C::dimension;
  double coarse = 0.0;
  for (const std::ptrdiff_t cells : {24, 48, 96}) {
    if (D == 3 && cells > 50) continue;
    const Sphere<D> exact = scenes::sphere_aside<D>();
    const LevelSet<typename C::Reinit, D> level_set(lattice<D>(cells),
                                                    [&](const auto& x) { return exact(x) * scenes::tenfold<D>(x); });
    const double error = distance_error(level_set.band(), exact, 5.9) / static_cast<double>(cells);
    BOOST_TEST_MESSAGE(cells << " cells: " << error);
    if (coarse > 0.0) BOOST_TEST(support::observed_order(coarse, error) > order<typename C::Reinit> - 0.4);
    coarse = error;
  }
}

// The values know the distance to a few units of the fifth differences, and what they cannot tell apart stays.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_distance_stays_as_it_is_to_the_last_bit, C, Cases) {
  constexpr int D = C::dimension;
  const Sphere<D> exact = scenes::sphere_aside<D>();
  LevelSet<typename C::Reinit, D> level_set(lattice<D>(D == 2 ? 64 : 32), exact);
  BOOST_TEST(distance_error(level_set.band(), exact, 3.0) < 1e-13);
  const auto before = scenes::values(level_set);
  for (int call = 0; call < 3; ++call) level_set.reinitialise();
  BOOST_TEST((before == scenes::values(level_set)));
}

BOOST_AUTO_TEST_CASE(what_a_call_made_a_thousand_calls_do_not_move) {
  const Sphere<2> exact = scenes::sphere_aside<2>();
  LevelSet<ClosestPoint, 2> level_set(lattice<2>(32), [&](const auto& x) { return exact(x) * scenes::tenfold<2>(x); });
  const auto before = scenes::values(level_set);
  for (int call = 0; call < 1000; ++call) level_set.reinitialise();
  double drift = 0.0;
  const auto after = scenes::values(level_set);
  BOOST_REQUIRE(after.size() == before.size());
  for (std::size_t i = 0; i < after.size(); ++i) drift = std::max(drift, std::abs(after[i] - before[i]));
  // The second call corrects what the first left off at a few nodes, within the fifth-order error; then all stands.
  BOOST_TEST(drift * 32 < 1e-3);
  level_set.reinitialise();
  BOOST_TEST((after == scenes::values(level_set)));
}

BOOST_AUTO_TEST_CASE(single_precision_is_right_to_round_off) {
  const Sphere<3> exact = scenes::sphere_aside<3>();
  const LevelSet<ClosestPoint, 3, float> level_set(lattice<3>(32),
                                                   [&](const auto& x) { return exact(x) * scenes::tenfold<3>(x); });
  const LevelSet<ClosestPoint, 3, double> wide(lattice<3>(32),
                                               [&](const auto& x) { return exact(x) * scenes::tenfold<3>(x); });
  // 2^-24 of values up to ten half widths (60 spacings), times the sum of |W| of the kernel in three dimensions.
  BOOST_TEST(distance_error(level_set.band(), exact, 5.9) <
             distance_error(wide.band(), exact, 5.9) + 60.0 * 6e-8 * 8.0);
}

BOOST_AUTO_TEST_CASE(threads_do_not_change_a_bit) {
  const auto f = [](const Vec<3>& x) { return scenes::sphere_aside<3>()(x) * scenes::tenfold<3>(x); };
  const LevelSet<ClosestPoint, 3> one(lattice<3>(32), f, {}, Serial{});
  for (const int threads : {2, 3}) {
    const LevelSet<ClosestPoint, 3> several(lattice<3>(32), f, {}, OpenMP{threads});
    BOOST_TEST((scenes::values(one) == scenes::values(several)));
  }
}

// A slab two cells thick: under-resolved, so that no search can be exact; but nothing moves.
BOOST_AUTO_TEST_CASE(a_thin_slab_stays) {
  const auto lattice = Lattice<2>(Box<2>::cube(), 1.0 / 32.0, {true, false});
  const auto slab = [](const Vec<2>& x) { return std::abs(x[1] - 0.507) - 1.0 / 32.0; };
  LevelSet<ClosestPoint, 2> level_set(lattice, slab);
  for (int call = 0; call < 200; ++call) level_set.reinitialise();
  BOOST_TEST(distance_error(level_set.band(), slab, 1.0) < 0.01);
}
