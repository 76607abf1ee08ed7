// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE totals
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <random>
#include <string>
#include <tuple>

#include <cambium/particles/particles.hpp>
#include <cambium/particles/totals.hpp>

using namespace cambium;
using Rational = boost::multiprecision::cpp_rational;

namespace {

template <int D, class T>
struct Case {
  static constexpr int dimension = D;
  using Scalar = T;
};
using Cases = std::tuple<Case<1, double>, Case<2, double>, Case<3, double>, Case<2, float>>;

double exact_sum(const std::vector<double>& terms) {
  Rational sum = 0;
  for (const double term : terms) sum += Rational(term);
  return sum.convert_to<double>();
}

template <int D, class T>
struct Cloud {
  Particles<D, T> particles;
  Attribute<T> mass = particles.template add<T>("mass");
  Attribute<Vec<2, T>> pair = particles.template add<Vec<2, T>>("pair");

  explicit Cloud(std::size_t count) {
    particles.resize(count);
    std::mt19937_64 random(count);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    particles.for_each_array([&](auto& array) {
      for (auto& x : array) x = static_cast<std::remove_reference_t<decltype(x)>>(unit(random));
    });
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(moments_as_in_exact_arithmetic, C, Cases) {
  constexpr int D = C::dimension;
  const Cloud<D, typename C::Scalar> cloud(3000);  // more than one piece of 1024
  const auto x = cloud.particles.positions();
  const auto exponents = exponents_up_to<D>(4);
  Vec<D> about;
  about[0] = 0.25;
  const auto scalars = moments_up_to(4, x, cloud.particles[cloud.mass], about);
  const auto pairs = moments_up_to(4, x, cloud.particles[cloud.pair], about);
  for (std::size_t k = 0; k < exponents.size(); ++k) {
    std::array<std::vector<double>, 3> terms;
    for (std::size_t p = 0; p < x.size(); ++p) {
      // The terms in double: their rounding is no part of the summation. 0.25 leaves float positions exact.
      double power = 1.0;
      for (int d = 0; d < D; ++d) {
        for (std::ptrdiff_t i = 0; i < exponents[k][d]; ++i) power *= static_cast<double>(x[p][d]) - about[d];
      }
      terms[0].push_back(static_cast<double>(cloud.particles[cloud.mass][p]) * power);
      for (int c = 0; c < 2; ++c) {
        terms[1 + c].push_back(static_cast<double>(cloud.particles[cloud.pair][p][c]) * power);
      }
    }
    const double found[3] = {scalars[k], pairs[k][0], pairs[k][1]};
    for (int i = 0; i < 3; ++i) {
      const double exact = exact_sum(terms[i]);
      // Compensated: half a unit in the last place for each of high + low and the reference, and nothing for 3000
      // terms.
      BOOST_TEST(std::abs(found[i] - exact) <= 2.3e-16 * std::abs(exact));
    }
  }
}

BOOST_AUTO_TEST_CASE(exponents_come_by_degree) {
  const std::vector<Index<3>> expected{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0},
                                       {1, 1, 0}, {1, 0, 1}, {0, 2, 0}, {0, 1, 1}, {0, 0, 2}};
  BOOST_TEST((exponents_up_to<3>(2) == expected));
  BOOST_TEST(exponents_up_to<3>(5).size() == 56u);  // C(5 + 3, 3)
  BOOST_TEST(exponents_up_to<2>(5).size() == 21u);
  BOOST_TEST(exponents_up_to<1>(5).size() == 6u);
  BOOST_TEST(exponents_up_to<2>(-1).empty());
}

BOOST_AUTO_TEST_CASE(cancelling_terms_are_kept) {
  // In a plain sum the ones are lost beside 1e16 (spacing of doubles there: 2).
  std::vector<double> terms;
  for (int i = 0; i < 5000; ++i) terms.insert(terms.end(), {1e16, 1.0, -1e16});
  BOOST_TEST(total(terms) == 5000.0);
  BOOST_TEST(total(std::vector<double>{}) == 0.0);
}

BOOST_AUTO_TEST_CASE(result_does_not_depend_on_threads) {
  const Cloud<3, double> cloud(50000);
  const auto all = [&](const auto& execution) {
    return moments_up_to(3, cloud.particles.positions(), cloud.particles[cloud.pair], {}, execution);
  };
  const auto serial = all(Serial{});
  for (int threads = 1; threads <= 4; ++threads) BOOST_TEST((all(OpenMP{threads}) == serial));
}

BOOST_AUTO_TEST_CASE(bad_input) {
  Cloud<2, double> cloud(2000);
  const auto refuses = []<class E>(const E*, auto&& f, const std::string& part) {
    BOOST_CHECK_EXCEPTION(
        f(), E, [&](const Error& error) { return std::string(error.what()).find(part) != std::string::npos; });
  };
  const ValueError* value = nullptr;
  const SizeError* size = nullptr;
  const auto x = cloud.particles.positions();
  const double infinity = std::numeric_limits<double>::infinity();
  refuses(
      size,
      [&] {
        moment(x, std::vector<double>(5), {0, 0});
      },
      "array of strengths has 5 entries where 2000");
  refuses(
      value,
      [&] {
        moment(x, cloud.particles[cloud.mass], {1, -1});
      },
      "exponents (1, -1) of a moment");
  cloud.particles[cloud.mass][1500] = infinity;
  refuses(
      value, [&] { total(cloud.particles[cloud.mass]); }, "strength of particle 1500 is inf:");
  cloud.particles[cloud.pair].set(1200, {0.0, -infinity});
  refuses(
      value, [&] { total(cloud.particles[cloud.pair]); }, "strength of particle 1200 is -inf in component 1:");
  refuses(
      value, [&] { total(std::vector<double>(3, 1e308)); }, "it overflows");
  x.set(3, {infinity, 0.0});
  refuses(
      value,
      [&] {
        moment(x, std::vector<double>(2000), {1, 0});
      },
      "position of particle 3 is inf in component 0");
}
