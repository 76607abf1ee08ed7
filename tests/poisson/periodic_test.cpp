// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE periodic
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <support/order.hpp>
#include <tuple>
#include <utility>

#include <cambium/operators/differences.hpp>
#include <cambium/poisson.hpp>

using cambium::component;
using cambium::Field;
using cambium::FourthOrder;
using cambium::Lattice;
using cambium::PeriodicPoisson;
using cambium::SecondOrder;
using cambium::Spectral;
using cambium::Vec;

namespace {

constexpr double pi = std::numbers::pi;

template <int D, class Number>
struct Case {
  static constexpr int dimension = D;
  using T = Number;
};
using Cases = std::tuple<Case<1, double>, Case<2, double>, Case<3, double>, Case<2, float>>;

template <class S, int D>
struct Stencil {
  using Symbol = S;
  static constexpr int dimension = D;
};
using Stencils =
    std::tuple<Stencil<SecondOrder, 1>, Stencil<SecondOrder, 3>, Stencil<FourthOrder, 2>, Stencil<FourthOrder, 3>>;

/// A box that starts away from the origin, with another number of nodes along each axis: 16, 15 and 12.
template <int D>
Lattice<D> uneven_lattice() {
  const double h = 0.05;
  const double nodes[3] = {16, 15, 12};
  cambium::Box<D> box;
  for (int d = 0; d < D; ++d) {
    box.lo[d] = -0.3 + 0.1 * d;
    box.hi[d] = box.lo[d] + nodes[d] * h;
  }
  std::array<bool, D> periodic;
  periodic.fill(true);
  return Lattice<D>(box, h, periodic);
}

/// Two waves, one along all axes and one along the last, with their Laplacian and gradient.
template <int D>
struct Waves {
  Vec<D> k;
  explicit Waves(const Lattice<D>& lattice) {
    for (int d = 0; d < D; ++d) k[d] = 2.0 * pi * (1 + d) / lattice.box().extent()[d];
  }
  double value(const Vec<D>& x) const { return std::sin(dot(k, x)) + 0.5 * std::cos(2.0 * k[D - 1] * x[D - 1]); }
  double minus_laplacian(const Vec<D>& x) const {
    const double last = 2.0 * k[D - 1];
    return dot(k, k) * std::sin(dot(k, x)) + 0.5 * last * last * std::cos(last * x[D - 1]);
  }
  Vec<D> gradient(const Vec<D>& x) const {
    const double last = 2.0 * k[D - 1];
    return k * std::cos(dot(k, x)) - Vec<D>::unit(D - 1, 0.5 * last * std::sin(last * x[D - 1]));
  }
};

template <class V, int D, class F>
double largest_error(const Field<V, D>& field, F&& exact) {
  double error = 0.0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const auto expected = exact(field.lattice().position(field.lattice().node(i)));
    for (int c = 0; c < cambium::Components<V>::count; ++c) {
      error = std::max(error, std::abs(static_cast<double>(component(field[i], c)) - component(expected, c)));
    }
  }
  return error;
}

template <int D>
Field<double, D> noise_without_mean(const Lattice<D>& lattice) {
  Field<double, D> f(lattice);
  std::mt19937 random(7);
  double sum = 0.0;
  for (double& value : f.values()) {
    value = std::uniform_real_distribution<>(-1.0, 1.0)(random);
    sum += value;
  }
  for (double& value : f.values()) value -= sum / static_cast<double>(f.size());
  return f;
}

/// A symbol that forgets the shortest wave.
struct Flat {
  static constexpr int order = 2;
  static double second(double theta) { return std::abs(theta) < 3.1 ? theta * theta : 0.0; }
  static double first(double theta) { return theta; }
};

/// A smooth function with all wave numbers, and minus its Laplacian: sum_d exp(sin 2 pi x_d).
template <class Symbol, int D>
double smooth_error(std::ptrdiff_t cells) {
  const auto lattice = Lattice<D>::periodic_box(cambium::Box<D>::cube(), cells);
  double mean = 0.0;  // of exp(sin), a Bessel function; the trapezoidal rule has it to round-off
  for (int i = 0; i < 64; ++i) mean += std::exp(std::sin(2.0 * pi * i / 64.0)) / 64.0;
  const auto f = sample(lattice, [](const Vec<D>& x) {
    double sum = 0.0;
    for (int d = 0; d < D; ++d) {
      const double s = std::sin(2.0 * pi * x[d]);
      sum += 4.0 * pi * pi * (s - (1.0 - s * s)) * std::exp(s);
    }
    return sum;
  });
  Field<double, D> u(lattice);
  PeriodicPoisson<D, Symbol> poisson(lattice, {.mean = cambium::MeanPart::subtract});
  poisson.solve(f, u);
  return largest_error(u, [&](const Vec<D>& x) {
    double sum = 0.0;
    for (int d = 0; d < D; ++d) sum += std::exp(std::sin(2.0 * pi * x[d])) - mean;
    return sum;
  });
}

}  // namespace

// Round-off: 1e-12 of the largest value in double, 1e-5 in float (measured 7e-16 to 4e-15 and 6e-7).
BOOST_AUTO_TEST_CASE_TEMPLATE(waves_are_solved_and_derived_to_round_off, C, Cases) {
  constexpr int D = C::dimension;
  using T = typename C::T;
  const double tolerance = sizeof(T) == sizeof(double) ? 1e-12 : 1e-5;
  const auto lattice = uneven_lattice<D>();
  const Waves<D> waves(lattice);
  Field<T, D> f(lattice);
  f.sample([&](const Vec<D>& x) { return static_cast<T>(waves.minus_laplacian(x)); });
  Field<T, D> u(lattice);
  PeriodicPoisson<D, Spectral, T> poisson(lattice);
  poisson.solve(f, u);
  BOOST_TEST_MESSAGE("error " << largest_error(u, [&](const Vec<D>& x) { return waves.value(x); }));
  BOOST_TEST(largest_error(u, [&](const Vec<D>& x) { return waves.value(x); }) < tolerance);

  Field<Vec<D, T>, D> g(lattice);
  poisson.gradient(u, g);
  BOOST_TEST(largest_error(g, [&](const Vec<D>& x) { return waves.gradient(x); }) < tolerance * norm(waves.k));

  poisson.solve(f, f);  // in place
  BOOST_TEST((std::equal(f.values().begin(), f.values().end(), u.values().begin())));
}

// Against stencils written elsewhere as sums over neighbours. Round-off: eps |u| / h^2 = 2e-16 * 0.01 * 400 and a few.
BOOST_AUTO_TEST_CASE_TEMPLATE(stencil_symbols_solve_the_difference_equations, S, Stencils) {
  constexpr int D = S::dimension;
  const auto lattice = uneven_lattice<D>();
  const auto f = noise_without_mean(lattice);
  Field<double, D> u(lattice);
  PeriodicPoisson<D, typename S::Symbol> poisson(lattice);
  poisson.solve(f, u);
  Field<double, D> laplacian(lattice);
  using Difference = cambium::CentredDifference<S::Symbol::order>;
  Difference::laplacian(u, laplacian);
  double residual = 0.0;
  for (std::size_t i = 0; i < f.size(); ++i) residual = std::max(residual, std::abs(f[i] + laplacian[i]));
  BOOST_TEST_MESSAGE("residual " << residual);
  BOOST_TEST(residual < 1e-12);

  if constexpr (D > 1) {
    Field<Vec<D>, D> g(lattice);
    Field<Vec<D>, D> expected(lattice);
    poisson.gradient(u, g);
    Difference::gradient(u, expected);
    double difference = 0.0;
    for (std::size_t i = 0; i < g.size(); ++i) difference = std::max(difference, norm(g[i] - expected[i]));
    BOOST_TEST(difference < 1e-13);
  }
}

// Theory: the order of the stencil; measured at these resolutions within 0.05.
BOOST_AUTO_TEST_CASE_TEMPLATE(stencil_symbols_converge_with_their_order, S, Stencils) {
  const double coarse = smooth_error<typename S::Symbol, S::dimension>(32);
  const double fine = smooth_error<typename S::Symbol, S::dimension>(64);
  BOOST_TEST_MESSAGE("measured order " << support::observed_order(coarse, fine));
  BOOST_TEST(std::abs(support::observed_order(coarse, fine) - S::Symbol::order) < 0.1);
}

BOOST_AUTO_TEST_CASE(spectral_error_falls_faster_than_any_power) {
  BOOST_TEST((smooth_error<Spectral, 2>(32) < 1e-12));
  BOOST_TEST((smooth_error<Spectral, 2>(8) > 1e-5));
}

// Implicit diffusion: a mean is damped like any wave. Round-off.
BOOST_AUTO_TEST_CASE(a_shift_solves_the_modified_helmholtz_equation) {
  const auto lattice = uneven_lattice<2>();
  const Waves<2> waves(lattice);
  const double shift = 40.0;
  const auto f =
      sample(lattice, [&](const Vec<2>& x) { return waves.minus_laplacian(x) + shift * (waves.value(x) + 3.0); });
  Field<double, 2> u(lattice);
  PeriodicPoisson<2> poisson(lattice, {.shift = shift});
  BOOST_TEST(poisson.solve(f, u) == 0.0);
  BOOST_TEST(largest_error(u, [&](const Vec<2>& x) { return waves.value(x) + 3.0; }) < 1e-12);
  BOOST_CHECK_THROW(PeriodicPoisson<2>(lattice, {.shift = -1.0}), cambium::ValueError);
}

BOOST_AUTO_TEST_CASE(the_shortest_wave_has_no_first_derivative) {
  const auto lattice = Lattice<2>::periodic_box(cambium::Box<2>::cube(), 16);
  Field<double, 2> q(lattice);
  for (std::size_t i = 0; i < q.size(); ++i) {
    const auto node = lattice.node(i);
    q[i] = std::sin(2.0 * pi * static_cast<double>(node[0]) / 16.0) * (node[1] % 2 == 0 ? 1.0 : -1.0);
  }
  Field<Vec<2>, 2> g(lattice);
  PeriodicPoisson<2>(lattice).gradient(q, g);
  for (const Vec<2>& slope : g.values()) BOOST_TEST(std::abs(slope[1]) < 1e-13);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(velocity_of_a_plane_vorticity, T, decltype(std::tuple<double, float>())) {
  const double tolerance = sizeof(T) == sizeof(double) ? 1e-12 : 1e-5;
  const auto lattice = uneven_lattice<2>();
  const Waves<2> psi(lattice);
  Field<T, 2> omega(lattice);
  omega.sample([&](const Vec<2>& x) { return static_cast<T>(psi.minus_laplacian(x)); });
  Field<Vec<2, T>, 2> u(lattice);
  PeriodicPoisson<2, Spectral, T>(lattice).velocity(omega, u);
  const auto exact = [&](const Vec<2>& x) { return Vec<2>{psi.gradient(x)[1], -psi.gradient(x)[0]}; };
  BOOST_TEST(largest_error(u, exact) < tolerance * norm(psi.k));
}

BOOST_AUTO_TEST_CASE(curl_and_divergence_of_the_difference_velocity) {
  // With stencil symbols div u = 0 holds in the same differences, whatever the vorticity.
  const auto lattice = uneven_lattice<2>();
  const auto omega = noise_without_mean(lattice);
  Field<Vec<2>, 2> u(lattice);
  PeriodicPoisson<2, FourthOrder>(lattice).velocity(omega, u);
  Field<double, 2> divergence(lattice);
  cambium::CentredDifference<4>::divergence(u, divergence);
  BOOST_TEST(largest_error(divergence, [](const Vec<2>&) { return 0.0; }) < 1e-13);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(velocity_of_a_vorticity_in_space, T, decltype(std::tuple<double, float>())) {
  // The Arnold-Beltrami-Childress flow of unequal amplitudes is its own curl; a second one has curl -2 u.
  const double tolerance = sizeof(T) == sizeof(double) ? 1e-12 : 1e-5;
  const auto lattice = Lattice<3>::periodic_box(cambium::Box<3>::cube(2.0 * pi), 12);
  const auto beltrami = [](const Vec<3>& x, double k) {
    return Vec<3>{std::sin(k * x[2]) + 0.3 * std::cos(k * x[1]), 0.7 * std::sin(k * x[0]) + std::cos(k * x[2]),
                  0.3 * std::sin(k * x[1]) + 0.7 * std::cos(k * x[0])};
  };
  const auto exact = [&](const Vec<3>& x) { return beltrami(x, 1.0) + 0.5 * beltrami(x, -2.0); };
  Field<Vec<3, T>, 3> omega(lattice);
  omega.sample([&](const Vec<3>& x) {
    const Vec<3> curl = beltrami(x, 1.0) - beltrami(x, -2.0);
    return Vec<3, T>{static_cast<T>(curl[0]), static_cast<T>(curl[1]), static_cast<T>(curl[2])};
  });
  Field<Vec<3, T>, 3> u(lattice);
  PeriodicPoisson<3, Spectral, T> poisson(lattice);
  poisson.velocity(omega, u);
  BOOST_TEST(largest_error(u, exact) < tolerance);

  // The vector stream function of a Beltrami wave of wave number k is omega / k^2 for each.
  poisson.solve(omega, u);
  BOOST_TEST(largest_error(u, [&](const Vec<3>& x) { return beltrami(x, 1.0) - 0.25 * beltrami(x, -2.0); }) <
             tolerance);
}

BOOST_AUTO_TEST_CASE(a_mean_is_refused_or_subtracted) {
  const auto lattice = Lattice<2>::periodic_box(cambium::Box<2>::cube(), 16);
  const auto f = sample(lattice, [](const Vec<2>& x) { return std::sin(2.0 * pi * x[0]) + 0.25; });
  Field<double, 2> u(lattice, 9.0);
  Field<Vec<2>, 2> v(lattice, Vec<2>{9.0, 9.0});
  PeriodicPoisson<2> strict(lattice);
  const auto names_the_mean = [](const cambium::ValueError& e) {
    return std::string(e.what()).find("has the mean 0.2") != std::string::npos;
  };
  BOOST_CHECK_EXCEPTION(strict.solve(f, u), cambium::ValueError, names_the_mean);
  BOOST_CHECK_EXCEPTION(strict.velocity(f, v), cambium::ValueError, names_the_mean);
  BOOST_TEST((u[5] == 9.0 && v[5] == Vec<2>{9.0, 9.0}));

  PeriodicPoisson<2> projecting(lattice, {.mean = cambium::MeanPart::subtract});
  BOOST_TEST(std::abs(projecting.solve(f, u) - 0.25) < 1e-15);
  BOOST_TEST(largest_error(u, [](const Vec<2>& x) { return std::sin(2.0 * pi * x[0]) / (4.0 * pi * pi); }) < 1e-15);
  PeriodicPoisson<2> tolerant(lattice, {.mean_tolerance = 0.5});
  BOOST_CHECK_NO_THROW(tolerant.solve(f, u));
  Field<double, 2> zero(lattice);
  strict.solve(zero, u);
  BOOST_TEST(u[7] == 0.0);
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused_and_changes_nothing) {
  const auto lattice = Lattice<2>::periodic_box(cambium::Box<2>::cube(), 16);
  BOOST_CHECK_THROW(PeriodicPoisson<2>(Lattice<2>::bounded_box(cambium::Box<2>::cube(), 16)), cambium::LatticeError);
  BOOST_CHECK_THROW(PeriodicPoisson<2>(Lattice<2>(cambium::Box<2>::cube(), 0.1, {true, false})), cambium::LatticeError);
  PeriodicPoisson<2> poisson(lattice);
  Field<double, 2> f(lattice);
  Field<double, 2> u(lattice, 9.0);
  Field<double, 2> other(Lattice<2>::periodic_box(cambium::Box<2>::cube(2.0), 16));
  Field<Vec<2>, 2> g(lattice, Vec<2>{9.0, 9.0});
  BOOST_CHECK_THROW(poisson.solve(other, u), cambium::SizeError);
  BOOST_CHECK_THROW(poisson.solve(f, other), cambium::SizeError);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    f[37] = bad;
    BOOST_CHECK_THROW(poisson.solve(f, u), cambium::ValueError);
    BOOST_CHECK_THROW(poisson.gradient(f, g), cambium::ValueError);
    BOOST_CHECK_THROW(poisson.velocity(f, g), cambium::ValueError);
  }
  BOOST_TEST((u[0] == 9.0 && g[0] == Vec<2>{9.0, 9.0}));

  BOOST_CHECK_THROW((PeriodicPoisson<2, Flat>(lattice)), cambium::ValueError);
}

BOOST_AUTO_TEST_CASE(solvers_can_be_moved_but_not_copied) {
  static_assert(!std::is_copy_constructible_v<PeriodicPoisson<2>>);
  static_assert(std::is_nothrow_move_constructible_v<cambium::PeriodicTransform<2>>);
  const auto lattice = uneven_lattice<2>();
  const auto f = noise_without_mean(lattice);
  Field<double, 2> u(lattice);
  Field<double, 2> again(lattice);
  PeriodicPoisson<2> first(lattice);
  first.solve(f, u);
  PeriodicPoisson<2> second = std::move(first);
  second.solve(f, again);
  BOOST_TEST((std::equal(u.values().begin(), u.values().end(), again.values().begin())));
  PeriodicPoisson<2> measured(lattice, {.planning = cambium::Planning::measure});
  measured.solve(f, again);
  BOOST_TEST(std::abs(u[11] - again[11]) < 1e-15);
}

BOOST_AUTO_TEST_CASE(threads_do_not_change_a_bit) {
  const auto lattice = Lattice<2>::periodic_box(cambium::Box<2>::cube(), 96);
  const auto f = noise_without_mean(lattice);
  const auto run = [&](int threads) {
    PeriodicPoisson<2> poisson(lattice, {}, cambium::OpenMP{threads});
    Field<Vec<2>, 2> u(lattice);
    poisson.velocity(f, u);
    return u;
  };
  const auto one = run(1);
  for (const int threads : {2, 3}) {
    const auto several = run(threads);
    BOOST_TEST((std::equal(one.values().begin(), one.values().end(), several.values().begin())));
  }
}
