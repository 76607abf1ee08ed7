// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE step_size
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include <cambium/particles/particles.hpp>
#include <cambium/time.hpp>

using cambium::Limit;
using cambium::StepSize;
using cambium::Vec;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Growth over 200 Euler steps of the highest mode of the lattice Laplacian in D dimensions.
template <int D>
double growth(double courant) {
  const double h = 0.1;
  const double nu = 0.3;
  const double dt = cambium::diffusion_limit(courant, h, nu, D).dt;
  return std::pow(std::abs(1.0 - dt * nu * 4.0 * D / (h * h)), 200.0);
}

}  // namespace

BOOST_AUTO_TEST_CASE(each_limit_is_its_formula) {
  BOOST_TEST((cambium::advection_limit(0.5, 0.1, 2.0) == StepSize{0.025, Limit::advection}));
  BOOST_TEST((cambium::strain_limit(0.5, 4.0) == StepSize{0.125, Limit::strain}));
  BOOST_TEST(std::abs(cambium::diffusion_limit(1.0, 0.1, 0.5, 2).dt - 0.1 * 0.1 / (2 * 2 * 0.5)) < 1e-16);
  // Order r: eps^2 / (r nu), i.e. eps^2 / (2 nu), eps^2 / (4 nu), eps^2 / (6 nu).
  for (const int order : {2, 4, 6}) {
    BOOST_TEST(std::abs(cambium::exchange_limit(1.0, 0.2, 0.5, order).dt - 0.04 / (order * 0.5)) < 1e-16);
  }
}

BOOST_AUTO_TEST_CASE(diffusion_limit_is_the_edge_of_stability) {
  BOOST_TEST(growth<1>(1.0) < 1.0 + 1e-12);
  BOOST_TEST(growth<2>(1.0) < 1.0 + 1e-12);
  BOOST_TEST(growth<3>(1.0) < 1.0 + 1e-12);
  BOOST_TEST(growth<1>(1.01) > 10.0);
  BOOST_TEST(growth<2>(1.01) > 10.0);
  BOOST_TEST(growth<3>(1.01) > 10.0);
}

BOOST_AUTO_TEST_CASE(the_smallest_limit_says_which_it_is) {
  const auto choose = [](double speed, double gradient, double nu, double left) {
    return cambium::smallest({cambium::advection_limit(1.0, 0.1, speed), cambium::strain_limit(0.5, gradient),
                              cambium::diffusion_limit(1.0, 0.1, nu, 2), cambium::exchange_limit(1.0, 0.1, nu / 4.0, 4),
                              cambium::given_limit(left)});
  };
  BOOST_TEST((choose(1000.0, 1.0, 0.01, 1.0).bound == Limit::advection));
  BOOST_TEST((choose(1.0, 1000.0, 0.01, 1.0).bound == Limit::strain));
  BOOST_TEST((choose(1.0, 1.0, 100.0, 1.0).bound == Limit::diffusion));
  BOOST_TEST((choose(0.0, 0.0, 0.0, 1.0) == StepSize{1.0, Limit::given}));
  BOOST_TEST((cambium::smallest({cambium::exchange_limit(1.0, 0.1, 1.0, 6), cambium::given_limit(1.0)}).bound ==
              Limit::particles));
  const StepSize free = cambium::smallest({cambium::advection_limit(1.0, 0.1, 0.0), cambium::strain_limit(1.0, 0.0)});
  BOOST_TEST((free.bound == Limit::none));
  BOOST_TEST(free.dt == infinity);
  BOOST_TEST((cambium::smallest({}).bound == Limit::none));
}

BOOST_AUTO_TEST_CASE(limits_have_names) {
  std::ostringstream out;
  out << cambium::strain_limit(0.5, 2.0);
  BOOST_TEST(out.str() == "dt = 0.25, bound by strain (Lagrangian CFL)");
  for (const Limit limit : {Limit::none, Limit::given, Limit::advection, Limit::diffusion, Limit::particles}) {
    BOOST_TEST(std::string(name(limit)) != "unknown limit");
  }
}

BOOST_AUTO_TEST_CASE(bad_numbers_are_refused) {
  for (const double bad : {-1.0, not_a_number, infinity}) {
    BOOST_CHECK_THROW(cambium::advection_limit(0.5, 0.1, bad), cambium::ValueError);
    BOOST_CHECK_THROW(cambium::strain_limit(0.5, bad), cambium::ValueError);
    BOOST_CHECK_THROW(cambium::diffusion_limit(0.5, 0.1, bad, 2), cambium::ValueError);
    BOOST_CHECK_THROW(cambium::exchange_limit(0.5, 0.1, bad, 2), cambium::ValueError);
  }
  for (const double bad : {0.0, -1.0, not_a_number, infinity}) {
    BOOST_CHECK_THROW(cambium::advection_limit(bad, 0.1, 1.0), cambium::ValueError);
    BOOST_CHECK_THROW(cambium::advection_limit(0.5, bad, 1.0), cambium::ValueError);
    BOOST_CHECK_THROW(cambium::strain_limit(bad, 1.0), cambium::ValueError);
    BOOST_CHECK_THROW(cambium::diffusion_limit(0.5, bad, 1.0, 2), cambium::ValueError);
    BOOST_CHECK_THROW(cambium::diffusion_limit(0.5, 0.1, 1.0, 2, bad), cambium::ValueError);
    BOOST_CHECK_THROW(cambium::exchange_limit(0.5, bad, 1.0, 2), cambium::ValueError);
    BOOST_CHECK_THROW(cambium::given_limit(bad), cambium::ValueError);
  }
  BOOST_CHECK_THROW(cambium::diffusion_limit(0.5, 0.1, 1.0, 0), cambium::ValueError);
}

BOOST_AUTO_TEST_CASE(rates_are_measured) {
  cambium::Particles<2> particles(5000);
  const auto velocity = particles.add<Vec<2>>("velocity");
  particles[velocity].set(4321, {3.0, -4.0});
  BOOST_TEST(cambium::largest_norm(particles[velocity]) == 5.0);
  BOOST_TEST(cambium::largest_norm(particles[velocity], cambium::OpenMP{3}) == 5.0);
  particles[velocity].set(17, {not_a_number, 0.0});
  BOOST_TEST(std::isnan(cambium::largest_norm(particles[velocity])));

  // u = (sin 2 pi y, 0, sin 4 pi x): the Frobenius norm of grad u is at most 2 pi sqrt(1 + 4), reached at the origin.
  const auto lattice = cambium::Lattice<3>::periodic_box(cambium::Box<3>::cube(), 64);
  const double pi = std::numbers::pi;
  const auto u = sample(lattice, [&](const Vec<3>& x) {
    return Vec<3>{std::sin(2 * pi * x[1]), 0.0, std::sin(4 * pi * x[0])};
  });
  const double exact = 2.0 * pi * std::sqrt(5.0);
  BOOST_TEST(std::abs(cambium::largest_gradient(u) / exact - 1.0) < 0.01);  // (4 pi h)^2 / 6 = 0.0064
  BOOST_TEST(std::abs(cambium::largest_norm(u) - std::sqrt(2.0)) < 0.01);

  // A linear field on a bounded lattice: every difference is exact, at the faces too.
  const auto bounded = cambium::Lattice<2>::bounded_box(cambium::Box<2>::cube(), 8);
  const auto linear = sample(bounded, [](const Vec<2>& x) { return Vec<2>{3.0 * x[0], 4.0 * x[1]}; });
  BOOST_TEST(std::abs(cambium::largest_gradient(linear) - 5.0) < 1e-12);
}
