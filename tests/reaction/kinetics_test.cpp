// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE kinetics
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <tuple>
#include <vector>

#include <cambium/reaction.hpp>

using namespace cambium;

namespace {

struct Named {
  template <class F>
  static void for_each(F&& f) {
    f(varea_spots);
    f(LinearisedBrusselator{0.899, -0.91, 0.5, 0.02, 0.2});
    f(LinearisedBrusselator{0.899, -0.91, 0.5, 0.0, 0.2});
    f(koch_meinhardt_spots);
    f(koch_meinhardt_stripes);
    f(KochMeinhardt{0.01, 0.02, 0.01, 0.003, 0.001, 0.02, 0.25});
    f(schnakenberg_spots);
    f(pearson_spots);
    f(GrayScott{0.04, 0.05});
  }
};

/// A user's own, of three species in a ring, without anything but the rates.
struct Ring {
  static constexpr int species = 3;
  Vec<3> operator()(const Vec<3>& c) const {
    return {1.0 - c[0] + 0.5 * c[2], c[0] * c[0] - c[1], std::sin(c[1]) - c[2]};
  }
};

template <class K>
struct WithoutJacobian {
  static constexpr int species = K::species;
  K kinetics;
  Vec<species> operator()(const Vec<species>& c) const { return kinetics(c); }
};

double sphere(int l, double radius) { return l * (l + 1.0) / (radius * radius); }

}  // namespace

BOOST_AUTO_TEST_CASE(rates_vanish_at_fixed_points_and_jacobians_are_their_derivatives) {
  Named::for_each([](const auto& kinetics) {
    check_kinetics<std::remove_cvref_t<decltype(kinetics)>>();
    BOOST_TEST(!kinetics.fixed_points().empty());
    for (const Vec<2>& c : kinetics.fixed_points()) BOOST_TEST(norm(kinetics(c)) < 1e-12 * (1.0 + norm(c)));
    for (const Vec<2>& c : {Vec<2>{0.7, -0.4}, Vec<2>{1.3, 2.1}}) {
      const WithoutJacobian<std::remove_cvref_t<decltype(kinetics)>> plain{kinetics};
      const Jacobian<2> exact = jacobian(kinetics, c), difference = jacobian(plain, c);
      // Differences with steps of 6e-6: truncation and round-off 1e-10 of the size of the rates (up to 100).
      for (int s = 0; s < 2; ++s) BOOST_TEST(norm(exact[s] - difference[s]) < 1e-8 * (1.0 + norm(exact[s])));
    }
  });
  BOOST_TEST(GrayScott({0.04, 0.05}).fixed_points().size() == 3U);
  BOOST_TEST(pearson_spots.fixed_points().size() == 1U);
  const Vec<2> stripes = koch_meinhardt_stripes.fixed_points()[0];
  BOOST_TEST(norm(stripes - Vec<2>{1.0, 1.25}) < 1e-15);
  BOOST_TEST(norm(fixed_point(koch_meinhardt_stripes, {1.2, 1.0}) - stripes) < 1e-13);
}

BOOST_AUTO_TEST_CASE(a_function_object_of_ones_own_has_everything) {
  check_kinetics<Ring>();
  const Vec<3> c = fixed_point(Ring{}, {1.0, 1.0, 1.0});
  BOOST_TEST(norm(Ring{}(c)) < 1e-13);
  // Without diffusion the rates are the eigenvalues of J: their sum and product are its trace and determinant.
  const auto rates = growth_rates(jacobian(Ring{}, c), Vec<3>{1.0, 2.0, 3.0}, 0.0);
  BOOST_TEST(std::abs(rates[0] + rates[1] + rates[2] + 3.0) < 1e-9);
  BOOST_TEST(std::abs(rates[0] * rates[1] * rates[2] - (-1.0 + c[0] * std::cos(c[1]))) < 1e-8);
  BOOST_CHECK_THROW(fixed_point(Ring{}, {NAN, 0.0, 0.0}), ValueError);
}

// Growth rates of spherical harmonics, computed in 40-digit arithmetic.
BOOST_AUTO_TEST_CASE(dispersion_of_the_brusselator_is_that_of_the_tables) {
  const auto rate = [](const Vec<2>& d, int l, double r) { return growth_rate(varea_spots, {}, d, sphere(l, r)); };
  constexpr Vec<2> six = varea_diffusivities, printed = varea_printed_diffusivities;
  const auto close = [](double found, double exact) { return std::abs(found - exact) < 1e-11; };
  BOOST_TEST(close(rate(six, 4, 2.0), 0.01180839167));
  BOOST_TEST(close(rate(six, 3, 2.0), -0.008697504485));
  BOOST_TEST(close(rate(six, 5, 2.0), -0.02249518915));
  BOOST_TEST(close(rate(six, 2, 1.0), 0.002434964346));
  BOOST_TEST(close(rate(six, 6, 3.0), 0.01302935921));
  BOOST_TEST(std::abs(rate(printed, 1, 1.0) - 0.3267458278) < 1e-10);
  BOOST_TEST(std::abs(rate(printed, 2, 1.0) - 0.1549432184) < 1e-10);
  BOOST_TEST(std::abs(rate(printed, 3, 1.0) + 0.2889527020) < 1e-10);
  const auto pair = growth_rates(varea_spots.jacobian({}), six, 0.0);
  BOOST_TEST(close(pair[0].real(), -0.0055));
  BOOST_TEST(std::abs(std::abs(pair[0].imag()) - 0.284394) < 1e-6);
  // With the minus sign in the second equation there would be another uniform state; with plus there is none.
  BOOST_TEST(varea_spots.fixed_points().size() == 1U);
  for (const Vec<2>& c : {Vec<2>{0.225, -0.211616582331}, Vec<2>{0.225, 236.2763799}}) {
    BOOST_TEST(norm(varea_spots(c)) > 1e-3);
    BOOST_TEST(std::abs(varea_spots(c)[0]) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(dispersion_of_koch_and_meinhardt_is_that_of_the_tables) {
  constexpr std::array spots{0.0009292512756, 0.002954037080, 0.003917553182, 0.004265265599, 0.004197865038,
                             0.003824005637,  0.003207949127, 0.002389831097, 0.001395732254, 0.0002431471761};
  constexpr std::array stripes{-0.0007781228467, 0.0007022347066, 0.001283920474,  0.001353842271,
                               0.001080014279,   0.0005499857224, -0.0001862077830};
  const auto compare = [](const KochMeinhardt& kinetics, const auto& table) {
    for (std::size_t i = 0; i < table.size(); ++i) {
      const double k2 = sphere(3 + static_cast<int>(i), 0.3);
      const Vec<2> c = kinetics.fixed_points()[0];
      const double rate = growth_rate(kinetics, c, koch_meinhardt_unit_diffusivities, k2);
      BOOST_TEST(std::abs(rate - table[i]) < 1e-12);
      const Vec<2> v = growing_direction(kinetics.jacobian(c), koch_meinhardt_unit_diffusivities, k2, rate);
      BOOST_TEST(std::abs(norm(v) - 1.0) < 1e-14);
    }
  };
  compare(koch_meinhardt_spots, spots);
  compare(koch_meinhardt_stripes, stripes);
  BOOST_CHECK_THROW(growing_direction(varea_spots.jacobian({}), varea_diffusivities, 5.0, 1.0), ValueError);
}

using Scalars = std::tuple<double, float>;
BOOST_AUTO_TEST_CASE_TEMPLATE(reaction_adds_to_diffusion, T, Scalars) {
  constexpr std::size_t size = 5000;
  std::array<std::vector<T>, 2> c, rate;
  for (std::size_t s = 0; s < 2; ++s) {
    c[s].resize(size);
    rate[s].assign(size, T(2));
    for (std::size_t k = 0; k < size; ++k) c[s][k] = static_cast<T>(std::sin(static_cast<double>(k * (s + 1))));
  }
  const Columns<2, const T> from({c[0].data(), c[1].data()}, size);
  const auto run = [&](const auto& kinetics, const Vec<2>& factor, const auto& execution) {
    auto to = rate;
    react(kinetics, from, factor, Columns<2, T>({to[0].data(), to[1].data()}, size), execution);
    return to;
  };
  const auto added = run(varea_spots, {0.5, 3.0}, Serial{});
  const auto fresh = run(WithoutJacobian<LinearisedBrusselator>{varea_spots}, {}, Serial{});
  for (std::size_t k = 0; k < size; k += 99) {
    const Vec<2> f = varea_spots(Vec<2>{static_cast<double>(c[0][k]), static_cast<double>(c[1][k])});
    const double eps = 16.0 * static_cast<double>(std::numeric_limits<T>::epsilon());
    BOOST_TEST(std::abs(static_cast<double>(added[0][k]) - f[0] - 1.0) < eps);
    BOOST_TEST(std::abs(static_cast<double>(added[1][k]) - f[1] - 6.0) < eps);
    BOOST_TEST(std::abs(static_cast<double>(fresh[1][k]) - f[1]) < eps);
  }
  for (const int threads : {2, 3}) BOOST_TEST((run(varea_spots, {0.5, 3.0}, OpenMP{threads}) == added));
  BOOST_CHECK_THROW(react(varea_spots, from, {}, Columns<2, T>({rate[0].data(), rate[1].data()}, size - 1)), SizeError);
}

BOOST_AUTO_TEST_CASE(roots_of_polynomials) {
  const auto roots = real_roots({-6.0, 11.0, -6.0, 1.0});
  BOOST_TEST(roots.size() == 3U);
  for (std::size_t i = 0; i < 3; ++i) BOOST_TEST(std::abs(roots[i] - static_cast<double>(i + 1)) < 1e-12);
  BOOST_TEST(real_roots({1.0, 0.0, 1.0}).empty());
  for (const auto& root : polynomial_roots({0.0, 0.0, 2.0})) BOOST_TEST(std::abs(root) == 0.0);
  BOOST_CHECK_THROW(polynomial_roots({1.0, 0.0}), ValueError);
}
