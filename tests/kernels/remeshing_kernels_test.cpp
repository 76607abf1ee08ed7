// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE remeshing_kernels
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include <cambium/kernels/remeshing_kernel.hpp>

#include "exact.hpp"

using namespace cambium;
using exact::Kernels;
using exact::Rational;

namespace {

/// Points of [0, 1] that decide whether a polynomial vanishes there. W is one polynomial in t on [0, 1] for even
/// support, on [0, 1/2] and on [1/2, 1] for odd, so sum_j (j - t)^a W(t - j) has degree <= degree + a <= 9 + 9 there: a
/// polynomial that vanishes at 20 points of such an interval is zero. Hence what holds at these points is proven, not
/// sampled.
const std::vector<Rational>& proof_points() {
  static const std::vector<Rational> points = [] {
    std::vector<Rational> all;
    for (int i = 0; i <= 40; ++i) all.push_back(Rational(i, 40));
    return all;
  }();
  return points;
}

/// Jump of a derivative of W at break point i, or at 0 (twice the odd derivatives) for i = -1.
Rational jump(const exact::Kernel& w, int order, int i) {
  if (i < 0) return order % 2 == 0 ? Rational(0) : 2 * w.derivative(0, order, 0);
  const Rational x = w.break_point(i);
  return (i + 1 < w.pieces() ? w.derivative(i + 1, order, x) : Rational(0)) - w.derivative(i, order, x);
}

bool derivative_jumps(const exact::Kernel& w, int order) {
  for (int i = -1; i < w.pieces(); ++i) {
    if (jump(w, order, i) != 0) return true;
  }
  return false;
}

/// True if sum_j (j - t)^a W(t - j) = expected for all t.
bool moment_is(const exact::Kernel& w, int a, int expected) {
  for (const Rational& t : proof_points()) {
    if (w.moment(a, t) != expected) return false;
  }
  return true;
}

bool has_kronecker_values(const exact::Kernel& w) {
  bool kronecker = w.value(0) == 1;
  for (int k = 1; k <= w.support; ++k) kronecker = kronecker && w.value(k) == 0;
  return kronecker;
}

using Fraction = std::pair<long long, long long>;

bool value_is(const exact::Kernel& w, int quarters, const Fraction& expected) {
  return w.value(Rational(quarters, 4)) == Rational(expected.first, expected.second);
}

/// Largest sum_j |W(t - j)| over offsets t, at 32 of them (the maximum is at a multiple of 1/2 for every kernel here).
bool largest_absolute_sum_is(const exact::Kernel& w, const Fraction& expected) {
  Rational largest = 0;
  for (int i = 0; i < 32; ++i) {
    Rational sum = 0;
    for (int j = -w.support; j <= w.support; ++j) sum += abs(w.value(Rational(i, 32) - j));
    if (sum > largest) largest = sum;
  }
  return largest == Rational(expected.first, expected.second);
}

/// True if every coefficient of every piece in Bernstein form is >= 0, so that the function is.
bool is_non_negative_in_bernstein_form(const exact::Kernel& w) {
  const int degree = w.degree();
  for (int i = 0; i < w.pieces(); ++i) {
    const Rational from = i == 0 ? Rational(0) : w.break_point(i - 1);
    const Rational width = w.break_point(i) - from;
    Rational scale = 1;  // width^k (degree - k)! / degree!
    std::vector<Rational> b;
    for (int k = 0; k <= degree; ++k) {
      b.push_back(w.derivative(i, k, from) * scale);  // k-th forward difference of the coefficients
      if (k < degree) scale *= width / (degree - k);
    }
    for (int order = degree; order > 0; --order) {
      for (int k = order; k <= degree; ++k) b[k] += b[k - 1];
    }
    for (const Rational& coefficient : b) {
      if (coefficient < 0) return false;
    }
  }
  return true;
}

/// Values at k/4, k = 1, 2, ..., without those at nodes, and the largest sum_j |W(t - j)|, that an independent
/// derivation in exact arithmetic gave.
struct Expected {
  std::vector<Fraction> values;
  Fraction absolute_sum;
};

const std::map<std::string, Expected>& expected() {
  static const Expected m4_prime{{{111, 128}, {9, 16}, {29, 128}, {-9, 128}, {-1, 16}, {-3, 128}}, {5, 4}};
  static const Expected m6{
      {{3665, 4096}, {75, 128}, {955, 4096}, {-893, 8192}, {-25, 256}, {-295, 8192}, {117, 8192}, {3, 256}, {23, 8192}},
      {89, 64}};
  static const std::map<std::string, Expected> all{
      {"Hat", {{{3, 4}, {1, 2}, {1, 4}}, {1, 1}}},
      {"M3", {{{11, 16}, {1, 2}, {9, 32}, {1, 32}}, {1, 1}}},
      {"M4", {{{235, 384}, {23, 48}, {121, 384}, {9, 128}, {1, 48}, {1, 384}}, {1, 1}}},
      {"M4Prime", m4_prime},
      {"Lambda21", m4_prime},
      {"Lambda22", {{{915, 1024}, {9, 16}, {205, 1024}, {-81, 1024}, {-1, 16}, {-15, 1024}}, {5, 4}}},
      {"M6", m6},
      {"Lambda42", m6},
      {"M6TriplePrime",
       {{{4965, 5632},
         {75, 128},
         {2795, 11264},
         {-2367, 22528},
         {-25, 256},
         {-15, 352},
         {81, 5632},
         {3, 256},
         {81, 22528}},
        {89, 64}}},
      {"Lambda44",
       {{{477265, 524288},
         {75, 128},
         {114095, 524288},
         {-122449, 1048576},
         {-25, 256},
         {-29615, 1048576},
         {16605, 1048576},
         {3, 256},
         {1315, 1048576}},
        {89, 64}}},
      {"Lambda64",
       {{{1902663, 2097152},
         {1225, 2048},
         {499737, 2097152},
         {-1383669, 10485760},
         {-245, 2048},
         {-469611, 10485760},
         {301063, 10485760},
         {49, 2048},
         {62937, 10485760}},
        {381, 256}}},
      {"Lambda84",
       {{{15193719, 16777216},
         {19845, 32768},
         {4205661, 16777216},
         {-1184697, 8388608},
         {-2205, 16384},
         {-478107, 8388608},
         {2260799, 58720256},
         {567, 16384},
         {678501, 58720256}},
        {25609, 16384}}},
  };
  return all;
}

/// The quintic B-spline with its derivatives, from its definition by truncated powers:
/// B(x) = 1/5! sum_k (-1)^k C(6, k) max(x + 3 - k, 0)^5.
Rational quintic_spline(int derivative, const Rational& x) {
  const int binomial[] = {1, 6, 15, 20, 15, 6, 1};
  const int factorial[] = {120, 24, 6, 2};
  Rational sum = 0;
  for (int k = 0; k <= 6; ++k) {
    const Rational above = x + 3 - k;
    if (above > 0) sum += (k % 2 == 0 ? 1 : -1) * binomial[k] * exact::power(above, 5 - derivative);
  }
  return sum / factorial[derivative];
}

/// A user's kernel: only what the concept asks for.
struct UserHat {
  static constexpr int support = 2;
  static constexpr int moments = 1;
  static constexpr double value(double x) { return x < 0.0 ? value(-x) : x < 1.0 ? 1.0 - x : 0.0; }
};

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(statements_hold_at_compile_time, K, Kernels) {
  check_remeshing_kernel<K>();
  static_assert(is_interpolating<K> == K::interpolating && is_smoothing<K> != K::interpolating);
  static_assert(order_of<K> == K::moments + 1);
  BOOST_TEST(true);
}

BOOST_AUTO_TEST_CASE(a_users_kernel_needs_three_members) {
  check_remeshing_kernel<UserHat>();
  static_assert(is_interpolating<UserHat> && is_non_negative<UserHat>);
  BOOST_TEST(true);
}

BOOST_AUTO_TEST_CASE(declared_moments_vanish_identically) {
  for (const auto& k : exact::statements()) {
    for (int a = 0; a <= k.moments; ++a) {
      BOOST_TEST(moment_is(k.w, a, a == 0 ? 1 : 0), k.name << ": moment " << a);
    }
  }
}

BOOST_AUTO_TEST_CASE(declared_degree_is_the_largest) {
  for (const auto& k : exact::statements()) BOOST_TEST(!moment_is(k.w, k.moments + 1, 0), k.name);
}

BOOST_AUTO_TEST_CASE(continuity_class_is_exact) {
  for (const auto& k : exact::statements()) {
    for (int order = 0; order <= k.continuity; ++order) {
      BOOST_TEST(!derivative_jumps(k.w, order), k.name << ": derivative " << order);
    }
    BOOST_TEST(derivative_jumps(k.w, k.continuity + 1), k.name);
  }
}

BOOST_AUTO_TEST_CASE(nodal_values) {
  for (const auto& k : exact::statements()) BOOST_TEST(has_kronecker_values(k.w) == k.interpolating, k.name);
}

BOOST_AUTO_TEST_CASE(support_is_not_too_wide) {
  for (const auto& k : exact::statements()) {
    BOOST_TEST((k.w.value(Rational(k.w.support, 2) - Rational(1, 100)) != 0), k.name);
  }
}

BOOST_AUTO_TEST_CASE(tabulated_values) {
  for (const auto& k : exact::statements()) {
    int quarter = 0;
    for (const Fraction& value : expected().at(k.name).values) {
      if (++quarter % 4 == 0) ++quarter;
      BOOST_TEST(value_is(k.w, quarter, value), k.name << " at " << quarter << "/4");
    }
    BOOST_TEST(largest_absolute_sum_is(k.w, expected().at(k.name).absolute_sum), k.name);
  }
}

BOOST_AUTO_TEST_CASE(tabulated_values_of_the_outer_pieces) {
  BOOST_TEST((exact::kernel<Lambda64>().value(Rational(7, 2)) == Rational(-5, 2048)));
  BOOST_TEST((exact::kernel<Lambda84>().value(Rational(7, 2)) == Rational(-405, 65536)));
  BOOST_TEST((exact::kernel<Lambda84>().value(Rational(9, 2)) == Rational(35, 65536)));
  BOOST_TEST((exact::kernel<M3>().value(0) == Rational(3, 4)));
  BOOST_TEST((exact::kernel<M3>().value(1) == Rational(1, 8)));
  BOOST_TEST((exact::kernel<M4>().value(0) == Rational(2, 3)));
  BOOST_TEST((exact::kernel<M4>().value(1) == Rational(1, 6)));
}

// The first failing moments as polynomials of t, from the same derivation.
BOOST_AUTO_TEST_CASE(first_failing_moments) {
  const auto hat = exact::kernel<Hat>(), m3 = exact::kernel<M3>(), m4 = exact::kernel<M4>();
  const auto m4_prime = exact::kernel<M4Prime>(), m6_triple_prime = exact::kernel<M6TriplePrime>();
  const auto lambda22 = exact::kernel<Lambda22>(), m6 = exact::kernel<M6>();
  for (const Rational& t : proof_points()) {
    const Rational odd = t * (t - 1) * (2 * t - 1);
    const Rational quartic = 3 * t * t - 3 * t - 1;
    BOOST_REQUIRE((hat.moment(2, t) == -t * (t - 1)));
    BOOST_REQUIRE((m3.moment(2, t) == Rational(1, 4)));
    BOOST_REQUIRE((m4.moment(2, t) == Rational(1, 3)));
    BOOST_REQUIRE((m4_prime.moment(3, t) == odd));
    BOOST_REQUIRE((m6_triple_prime.moment(3, t) == -5 * odd / 22));
    BOOST_REQUIRE((lambda22.moment(3, t) == -odd * quartic));
    BOOST_REQUIRE((m6.moment(5, t) == 4 * odd * quartic));
  }
}

BOOST_AUTO_TEST_CASE(splines_do_not_overshoot) {
  for (const auto& k : exact::statements()) {
    const bool spline = k.moments == 1;
    BOOST_TEST(k.non_negative == spline, k.name);
    BOOST_TEST(is_non_negative_in_bernstein_form(k.w) == spline, k.name);
  }
}

BOOST_AUTO_TEST_CASE(kernels_that_are_one_function) {
  static_assert(std::is_same_v<Lambda<8, 4>, Lambda84> && std::is_same_v<Lambda<2, 2>, Lambda22>);
  BOOST_TEST((exact::kernel<Lambda21>().piece == exact::kernel<M4Prime>().piece));
  BOOST_TEST((exact::kernel<Lambda42>().piece == exact::kernel<M6>().piece));
}

BOOST_AUTO_TEST_CASE(m4_prime_is_the_extrapolated_cubic_spline) {
  const auto m4 = exact::kernel<M4>(), m4_prime = exact::kernel<M4Prime>();
  for (int i = 0; i <= 100; ++i) {
    const Rational x(i, 50);
    const Rational slope = m4.derivative(i < 50 ? 0 : 1, 1, x);
    BOOST_REQUIRE((m4_prime.value(x) == (3 * m4.value(x) + x * slope) / 2));
  }
}

BOOST_AUTO_TEST_CASE(m6_triple_prime_is_the_extrapolated_quintic_spline) {
  const auto w = exact::kernel<M6TriplePrime>();
  for (int i = -170; i <= 170; ++i) {
    const Rational x(i, 50);
    const Rational extrapolated = Rational(20, 11) * quintic_spline(0, x) + x * quintic_spline(1, x) +
                                  Rational(7, 88) * x * x * quintic_spline(2, x) -
                                  Rational(1, 264) * x * x * x * quintic_spline(3, x);
    BOOST_REQUIRE((w.value(x) == extrapolated));
  }
}

// Its continuous moments vanish up to degree 5 nevertheless: int x^2 W = int x^4 W = 0.
BOOST_AUTO_TEST_CASE(m6_triple_prime_has_continuous_moments) {
  const auto w = exact::kernel<M6TriplePrime>();
  for (int a = 0; a <= 4; a += 2) {
    Rational integral = 0;
    for (int i = 0; i < w.pieces(); ++i) {
      for (int j = 0; j <= w.degree(); ++j) {
        const Rational primitive = exact::power(i + 1, a + j + 1) - exact::power(i, a + j + 1);
        integral += 2 * primitive * w.piece[i][j] / (a + j + 1);
      }
    }
    BOOST_TEST((integral == (a == 0 ? 1 : 0)), "degree " << a);
  }
}
