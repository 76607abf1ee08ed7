// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE weno
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include <cambium/levelset/weno.hpp>

#include "support/order.hpp"

using namespace cambium;

using Schemes = std::tuple<Upwind1, ENO2, WENO3, WENO5>;

namespace {

/// Root mean square error of the one-sided derivatives of exp(sin(2 pi x)) at n nodes of a period.
template <class Scheme>
double derivative_error(int n, bool left) {
  const double h = 1.0 / n;
  const auto f = [&](int i) { return std::exp(std::sin(2.0 * std::numbers::pi * i * h)); };
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    std::vector<double> row;
    for (int k = -4; k <= 4; ++k) row.push_back(f(i + k));
    const auto differences = detail::node_differences<Scheme>(row.data() + 4, 1);
    const double exact = 2.0 * std::numbers::pi * std::cos(2.0 * std::numbers::pi * i * h) * f(i);
    const double found = (left ? differences.left() : differences.right()) / h;
    sum += (found - exact) * (found - exact);
  }
  return std::sqrt(sum / n);
}

}  // namespace

// The schemes lose order where the derivative is extreme or zero, at O(1) nodes of the n: the error in the mean square
// may lose half an order for it; WENO5's weights are free of this here.
BOOST_AUTO_TEST_CASE_TEMPLATE(orders_on_smooth_functions, Scheme, Schemes) {
  for (const bool left : {true, false}) {
    const double order =
        support::observed_order(derivative_error<Scheme>(128, left), derivative_error<Scheme>(256, left));
    BOOST_TEST_MESSAGE("order " << order << " error " << derivative_error<Scheme>(256, left));
    BOOST_TEST(order > Scheme::order - 0.5);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(parabolas_of_the_order_are_exact, Scheme, Schemes) {
  // Every sub-stencil of these schemes is exact for polynomials of degree 1, 2 (ENO2), 2 (WENO3), 3 (WENO5).
  const int degree = Scheme::order == 1 ? 1 : Scheme::order == 5 ? 3 : 2;
  std::array<double, 9> row;
  for (int k = -4; k <= 4; ++k) row[static_cast<std::size_t>(k + 4)] = 2.0 * k + std::pow(0.3 * k, degree);
  const double exact = degree == 1 ? 2.3 : 2.0;
  const auto differences = detail::node_differences<Scheme>(row.data() + 4, 1);
  BOOST_TEST(std::abs(differences.left() - exact) < 1e-13);
  BOOST_TEST(std::abs(differences.right() - exact) < 1e-13);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_kink_stays_on_its_side, Scheme, Schemes) {
  // Slope -1 to the left of node 0 and 2 to its right: each side sees its own, to the smallness of WENO's weights.
  for (const double scale : {1e-6, 1.0, 1e6}) {
    std::array<double, 9> row;
    for (int k = -4; k <= 4; ++k) row[static_cast<std::size_t>(k + 4)] = scale * (k < 0 ? -k : 2 * k);
    const auto differences = detail::node_differences<Scheme>(row.data() + 4, 1);
    BOOST_TEST(std::abs(differences.left() / scale + 1.0) < 1e-9);
    BOOST_TEST(std::abs(differences.right() / scale - 2.0) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(flat_and_tiny_values_give_no_nan, Scheme, Schemes) {
  for (const float value : {0.0f, 1e-30f, 1e-12f, 1e12f}) {
    std::array<float, 9> row;
    for (int k = 0; k < 9; ++k) row[static_cast<std::size_t>(k)] = value * static_cast<float>((k * k) % 5);
    const auto differences = detail::node_differences<Scheme>(row.data() + 4, 1);
    BOOST_TEST(std::isfinite(differences.left()));
    BOOST_TEST(std::isfinite(differences.right()));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(rows_agree_with_nodes, Scheme, Schemes) {
  constexpr std::size_t lanes = detail::row_lanes;
  std::array<double, 256> values;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(0.1 * static_cast<double>(i * i % 97));
  for (const std::ptrdiff_t stride : {1, 16}) {
    const double* at = values.data() + 100;
    const auto row = detail::row_differences<Scheme, lanes>(at, stride);
    alignas(64) double left[lanes], right[lanes], upwind[lanes], from_left[lanes];
    for (std::size_t l = 0; l < lanes; ++l) from_left[l] = l % 3 == 0 ? 1.0 : 0.0;
    row.left().store_aligned(left);
    row.right().store_aligned(right);
    row.upwind(simd::Pack<double, lanes>::load_aligned(from_left)).store_aligned(upwind);
    for (std::size_t l = 0; l < lanes; ++l) {
      const auto node = detail::node_differences<Scheme>(at + l, stride);
      // The compiler may contract the scalar form to fused operations.
      BOOST_TEST(std::abs(left[l] - node.left()) < 1e-13);
      BOOST_TEST(std::abs(right[l] - node.right()) < 1e-13);
      BOOST_TEST(upwind[l] == (l % 3 == 0 ? left[l] : right[l]));
    }
  }
}
