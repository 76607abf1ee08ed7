// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE fast_marching
#include <boost/test/unit_test.hpp>

#include <cambium/levelset/reinit/fast_marching.hpp>
#include <cambium/levelset/reinit/linear_kick_off.hpp>

#include "levelset/marching.hpp"

using namespace cambium;
using namespace marching;

using FirstOrder = FastMarching<ChoppKickOff, 1>;
using SecondOrder = FastMarching<>;

static_assert(Reinitialisation<FirstOrder> && Reinitialisation<SecondOrder>);
static_assert(Reinitialisation<FastMarching<LinearKickOff, 1>>);
static_assert(KickOff<ChoppKickOff> && KickOff<LinearKickOff>);

BOOST_AUTO_TEST_CASE_TEMPLATE(first_order, Case, Dimensions) {
  for (const bool scaled : {false, true}) {
    const Orders orders = measured_orders<FirstOrder, Case::value>(scaled);
    // Theory: 1 in a band of fixed width, from below; 2 within a fixed number of spacings of nodes that are exact.
    BOOST_TEST(orders.far > 0.7);
    BOOST_TEST(orders.far < 1.1);
    BOOST_TEST(orders.near > 1.7);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(second_order, Case, Dimensions) {
  for (const bool scaled : {false, true}) {
    const Orders orders = measured_orders<SecondOrder, Case::value>(scaled);
    // Theory: 2, from below, and 3 near nodes that are exact but for where the scheme falls back to first order.
    BOOST_TEST(orders.far > 1.65);
    BOOST_TEST(orders.far < 2.2);
    BOOST_TEST(orders.near > 2.3);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_plane_is_exact, Case, Dimensions) {
  constexpr int D = Case::value;
  const auto lattice = Lattice<D>::periodic_box(Box<D>::cube(), 20);
  const auto slab = [](const Vec<D>& x) { return std::abs(x[1] - 0.512) - 0.23; };
  const auto values = [&](const Vec<D>& x) { return slab(x) * (1.0 + slab(x)); };
  auto straight = support::make_band<double, D>(lattice, 0.2, slab, slab);
  reinitialise<SecondOrder>(straight);
  BOOST_TEST(support::largest_error(straight, 0.19, slab) < 1e-14);
  // Cubic patches have the parabola's zero set exactly, so that only the search's tolerance is left.
  auto bent = support::make_band<double, D>(lattice, 0.2, slab, values);
  reinitialise<SecondOrder>(bent);
  BOOST_TEST(support::largest_error(bent, 0.19, slab) < 1e-8);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(contract, Case, Dimensions) {
  check_contract<SecondOrder, double, Case::value>();
  check_contract<FirstOrder, float, Case::value>();
  check_contract<FastMarching<LinearKickOff, 1>, double, Case::value>();
}

BOOST_AUTO_TEST_CASE(float_is_as_good_as_its_rounding) {
  auto wide = ellipsoid_band<double, 3>(40, 0.12, false);
  auto narrow = ellipsoid_band<float, 3>(40, 0.12, false);
  reinitialise<SecondOrder>(wide);
  reinitialise<SecondOrder>(narrow);
  const auto exact = [](const Vec<3>& x) { return support::ellipsoid<3>().distance(x); };
  BOOST_TEST(std::abs(support::largest_error(wide, 0.11, exact) - support::largest_error(narrow, 0.11, exact)) < 1e-6);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(periodic_faces, Case, Dimensions) { check_periodic_faces<FirstOrder, Case::value>(); }

BOOST_AUTO_TEST_CASE_TEMPLATE(threads, Case, Dimensions) { check_threads<SecondOrder, Case::value>(); }

BOOST_AUTO_TEST_CASE_TEMPLATE(touching_balls, Case, Dimensions) {
  check_touching_balls<FirstOrder, Case::value>();
  check_touching_balls<SecondOrder, Case::value>();
}

BOOST_AUTO_TEST_CASE(not_finite) { check_not_finite<SecondOrder>(); }

BOOST_AUTO_TEST_CASE(no_allocation) { check_no_allocation<SecondOrder>(); }

BOOST_AUTO_TEST_CASE(the_queue_is_sorted_by_key_then_number) {
  detail::BucketHeap<double> queue;
  queue.reset(2.0, 0.25);
  std::vector<std::pair<double, int>> expected, found;
  for (int k = 0; k < 500; ++k) expected.emplace_back((k * 37 % 101) / 51.0, k * 7 % 500);
  for (const auto& [key, number] : expected) queue.push(key, number);
  std::sort(expected.begin(), expected.end());
  detail::BucketHeap<double>::Entry entry;
  const auto odd = [](const auto& e) { return e.number % 2 != 0; };
  while (queue.pop(entry, odd)) {
    found.emplace_back(entry.key, entry.number);
    // What comes in late with a key before the front comes out next.
    if (entry.number == 251) queue.push(0.0, 1001);
  }
  std::erase_if(expected, [](const auto& e) { return e.second % 2 == 0; });
  const auto late = std::find_if(expected.begin(), expected.end(), [](const auto& e) { return e.second == 251; });
  expected.insert(late + 1, {0.0, 1001});
  BOOST_TEST((found == expected));
}

// Values so rough that closest points of corners are not found: such nodes are marched to, on their own side.
BOOST_AUTO_TEST_CASE_TEMPLATE(rough_values_keep_their_signs, Case, marching::Dimensions) {
  constexpr int D = Case::value;
  const auto lattice = Lattice<D>::bounded_box(Box<D>::cube(), D == 2 ? 64 : 32);
  const double h = lattice.spacing();
  const auto distance = [](const Vec<D>& x) { return norm(x - Vec<D>::constant(0.5)) - 0.3; };
  const auto rough = [&](const Vec<D>& x) {
    double phase = 0.0;
    for (int d = 0; d < D; ++d) phase += (37.0 + 23.0 * d) * x[d] / h;
    return distance(x) + 3.0 * h * std::sin(phase * phase);
  };
  auto band = support::make_band<double, D>(lattice, 6.0 * h, distance, rough);
  const auto before = band;
  const ReinitReport report = marching::reinitialise<FastMarching<>>(band);
  BOOST_TEST(report.not_converged > 0U);
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      if (!lattice.contains(band.values().node(b, i))) continue;
      BOOST_REQUIRE((band.values().block(b)[i] < 0.0) == (before.values().block(b)[i] < 0.0));
    }
  }
}
