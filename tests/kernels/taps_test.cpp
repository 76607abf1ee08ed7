// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE taps
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <tuple>

#include <cambium/kernels.hpp>

using namespace cambium;

namespace {

/// A user's kernel that tells its degree and not its coefficients.
struct WithDegree {
  static constexpr int support = 6;
  static constexpr int moments = 4;
  static constexpr int degree = 5;
  template <class T>
  static constexpr T value(T x) {
    return M6::value(x);
  }
};

/// The same of odd support, in double alone.
struct OddWithDegree {
  static constexpr int support = 3;
  static constexpr int moments = 1;
  static constexpr int degree = 2;
  static constexpr double value(double x) {
    const double r = x < 0.0 ? -x : x;
    return r >= 1.5 ? 0.0 : r > 0.5 ? 0.5 * (1.5 - r) * (1.5 - r) : 0.75 - r * r;
  }
};

/// Nothing but values.
struct ValueOnly {
  static constexpr int support = 4;
  static constexpr int moments = 2;
  static constexpr double value(double x) { return M4Prime::value(x); }
};

using TapKernels = std::tuple<Hat, M3, M4, M4Prime, M6, M6TriplePrime, Lambda22, Lambda44, Lambda64, Lambda84,
                              WithDegree, OddWithDegree, ValueOnly, Delta3, Delta4, DeltaCosine, Delta6>;

/// Largest difference of a weight from value(), and of the sum of the weights from 1, over the offsets [-1/2, 1/2).
template <class K, class T>
std::pair<double, double> largest_errors() {
  double weight_error = 0.0, sum_error = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const T g = static_cast<T>(i / 1000.0 - 0.5);
    T w[K::support];
    Taps<K>::weights(g, w);
    double sum = 0.0;
    for (int k = 0; k < K::support; ++k) {
      const double at = static_cast<double>(g) + (0.5 * (K::support - 1) - k);
      weight_error = std::max(weight_error, std::abs(static_cast<double>(w[k]) - static_cast<double>(K::value(at))));
      sum += static_cast<double>(w[k]);
    }
    sum_error = std::max(sum_error, std::abs(sum - 1.0));
  }
  constexpr double unit = static_cast<double>(std::numeric_limits<T>::epsilon());
  return {weight_error / unit, sum_error / unit};
}

}  // namespace

// Both sides are polynomials about the middle of a piece with coefficients right to half a unit: 2 units of the largest
// weight (at most 1) between them, `support` roundings in the sum. Measured: at most 1 unit, 3 units in the sum.
BOOST_AUTO_TEST_CASE_TEMPLATE(weights_are_the_values_and_sum_to_one, K, TapKernels) {
  static_assert(Taps<K>::polynomial == (
                                           requires { K::pieces; } || requires { K::degree; }));
  const auto [weight, sum] = largest_errors<K, double>();
  BOOST_TEST_MESSAGE(weight << " " << sum);
  BOOST_TEST(weight <= 1.8);
  BOOST_TEST(sum <= 4.0);
  const auto [weight_float, sum_float] = largest_errors<K, float>();
  BOOST_TEST(weight_float <= 2.0);
  BOOST_TEST(sum_float <= 4.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(stencil_covers_the_support, K, TapKernels) {
  // At position u the nodes cell - before, ..., cell - before + support - 1 are those within support / 2 of u.
  for (const double u : {0.0, 0.25, 0.5, 0.75, 0.999}) {
    const double cell = std::floor(u + Taps<K>::shift);
    const double first = cell - Taps<K>::before;
    BOOST_TEST(u - first <= 0.5 * K::support);
    BOOST_TEST(first + K::support - 1 - u <= 0.5 * K::support);
  }
}

BOOST_AUTO_TEST_CASE(a_kernel_with_degree_has_the_same_taps_as_one_with_pieces) {
  for (int j = 0; j <= 5; ++j) {
    for (int k = 0; k < 6; ++k) {
      // Fitted in extended precision: right to the last bit of the largest coefficient of a tap, 2.8.
      BOOST_TEST(std::abs(Taps<WithDegree>::coefficients.value[j][k] - Taps<M6>::coefficients.value[j][k]) <= 4.5e-16);
    }
  }
  check_remeshing_kernel<WithDegree>();
  check_remeshing_kernel<OddWithDegree>();
  check_remeshing_kernel<ValueOnly>();
}
