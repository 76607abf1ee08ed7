// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE state_adaptors
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <tuple>
#include <vector>

#include <cambium/particles/particles.hpp>
#include <cambium/time.hpp>

using cambium::Columns;
using cambium::Vec;

namespace {

/// A user's own state: two arrays of different types and lengths.
struct Oscillators {
  std::vector<double> position;
  std::vector<Vec<2, float>> others;

  auto arrays() { return std::tuple(std::span(position), std::span(others)); }
  auto arrays() const { return std::tuple(std::span(position), std::span(others)); }
};

/// Decay at rate 1, by RK4, of every number of a state for one step of 0.1: the factor is the polynomial of degree 4.
constexpr double factor = 1.0 - 0.1 + 0.01 / 2.0 - 0.001 / 6.0 + 0.0001 / 24.0;
constexpr auto decay = [](const auto& state, double, auto&& derivative) {
  for (std::size_t i = 0; i < state.size(); ++i)
    derivative[i] = state[i] * typename std::remove_cvref_t<decltype(state)>::value_type(-1);
};

using Vectors = std::tuple<std::vector<double>, std::vector<float>, cambium::AlignedVector<double>>;
using Fields = std::tuple<cambium::Field<double, 1>, cambium::Field<double, 2>, cambium::Field<float, 3>>;

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(vectors_are_states, S, Vectors) {
  S state{1, 2, 3};
  cambium::RK4<S>().step(state, 0.0, 0.1, decay);
  for (int i = 0; i < 3; ++i) BOOST_TEST(std::abs(static_cast<double>(state[i]) - factor * (i + 1)) < 1e-6);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(fields_are_states, S, Fields) {
  const auto lattice = cambium::Lattice<S::dimension>::periodic_box(cambium::Box<S::dimension>::cube(), 8);
  S field(lattice, typename S::value_type(2));
  cambium::RK4<S> stepper(field);
  stepper.step(field, 0.0, 0.1, decay);
  BOOST_TEST(std::abs(static_cast<double>(field[field.size() - 1]) - 2.0 * factor) < 1e-6);

  // Another lattice with as many nodes: the stages must take its geometry too.
  const cambium::Box<S::dimension> twice = cambium::Box<S::dimension>::cube(2.0);
  S other(cambium::Lattice<S::dimension>::periodic_box(twice, 8), typename S::value_type(2));
  stepper.step(other, 0.0, 0.1, [&](const S& at, double t, S& derivative) {
    BOOST_TEST((at.lattice() == other.lattice()));
    BOOST_TEST((derivative.lattice() == other.lattice()));
    decay(at, t, derivative);
  });
}

BOOST_AUTO_TEST_CASE(fields_of_vectors_are_states) {
  using S = cambium::Field<Vec<2>, 2>;
  S field(cambium::Lattice<2>::periodic_box(cambium::Box<2>::cube(), 4), Vec<2>{1.0, -3.0});
  cambium::RK4<S> stepper;
  stepper.step(field, 0.0, 0.1, [](const S& at, double, S& d) {
    for (std::size_t i = 0; i < at.size(); ++i) d[i] = at[i] * -1.0;
  });
  BOOST_TEST(norm(field[5] - Vec<2>{1.0, -3.0} * factor) < 1e-15);
}

BOOST_AUTO_TEST_CASE(positions_and_strengths_advance_together) {
  cambium::Particles<3> particles(5);
  const auto mass = particles.add<double>("mass", 4.0);
  const auto spin = particles.add<Vec<2, float>>("spin", {1.0F, 2.0F});
  for (std::size_t p = 0; p < 5; ++p) particles.positions().set(p, Vec<3>::constant(static_cast<double>(p)));
  const auto state = [&] { return std::tuple(particles.positions(), particles[mass], particles[spin]); };
  cambium::TVDRK3 stepper(state());
  const auto rhs = [](const auto& at, double, const auto& derivative) {
    const auto& [x, m, s] = at;
    const auto& [dx, dm, ds] = derivative;
    static_assert(std::is_same_v<std::remove_cvref_t<decltype(x)>, Columns<3, const double>>);
    for (std::size_t p = 0; p < x.size(); ++p) {
      dx.set(p, Vec<3>{1.0, m[p], 0.0});
      dm[p] = -m[p];
      ds.set(p, {-s[p][0], 0.0F});
    }
  };
  stepper.step(state(), 0.0, 0.1, rhs);
  const double third = 1.0 - 0.1 + 0.01 / 2.0 - 0.001 / 6.0;
  BOOST_TEST(std::abs(particles[mass][3] - 4.0 * third) < 1e-14);
  BOOST_TEST(std::abs(particles.positions()[3][1] - (3.0 + 4.0 * (0.1 - 0.005 + 0.001 / 6.0))) < 1e-14);
  BOOST_TEST(std::abs(static_cast<double>(particles[spin][3][0]) - third) < 1e-6);
  BOOST_TEST(particles[spin][3][1] == 2.0F);

  particles.resize(9);  // as after remeshing
  stepper.step(state(), 0.1, 0.1, rhs);
  BOOST_TEST(std::abs(particles[mass][8] - 4.0 * third) < 1e-14);
}

BOOST_AUTO_TEST_CASE(owners_are_advanced_through_references) {
  std::vector<double> a{1.0};
  cambium::Field<double, 1> b(cambium::Lattice<1>::periodic_box(cambium::Box<1>::cube(), 3), 1.0);
  auto state = std::tie(a, b);
  cambium::RK4 stepper(state);
  stepper.step(std::tie(a, b), 0.0, 0.1, [](const auto& at, double t, const auto& d) {
    decay(std::get<0>(at), t, std::get<0>(d));
    decay(std::get<1>(at), t, std::get<1>(d));
  });
  BOOST_TEST(std::abs(a[0] - factor) < 1e-15);
  BOOST_TEST(std::abs(b[2] - factor) < 1e-15);
}

BOOST_AUTO_TEST_CASE(a_struct_with_arrays_is_a_state) {
  static_assert(cambium::State<Oscillators>);
  static_assert(cambium::Stepper<cambium::RK4<Oscillators>, Oscillators>);
  Oscillators state{{1.0, 2.0}, {{3.0F, 4.0F}}};
  cambium::RK4 stepper(state);
  stepper.step(state, 0.0, 0.1, [](const Oscillators& at, double, Oscillators& d) {
    for (std::size_t i = 0; i < at.position.size(); ++i) d.position[i] = -at.position[i];
    for (std::size_t i = 0; i < at.others.size(); ++i) d.others[i] = -at.others[i];
  });
  BOOST_TEST(std::abs(state.position[1] - 2.0 * factor) < 1e-15);
  BOOST_TEST(std::abs(static_cast<double>(state.others[0][1]) - 4.0 * factor) < 1e-6);
}

// What is not a state says so through the concept.
static_assert(!cambium::State<double>);
static_assert(!cambium::State<std::span<const double>>);
static_assert(!cambium::State<Columns<2, const double>>);
static_assert(cambium::State<std::tuple<Columns<2, double>, std::span<float>>>);
static_assert(cambium::Stepper<cambium::Euler<std::vector<double>>, std::vector<double>>);
static_assert(cambium::Stepper<cambium::TVDRK2<std::vector<double>>, std::vector<double>>);
static_assert(cambium::Stepper<cambium::TVDRK3<std::vector<double>>, std::vector<double>>);
