// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE stepper
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <support/order.hpp>
#include <tuple>
#include <vector>

#include <cambium/particles/particles.hpp>
#include <cambium/time.hpp>

using cambium::Columns;
using cambium::Vec;

namespace {

struct UseEuler {
  template <class S>
  using Method = cambium::Euler<S>;
};
struct UseTVDRK2 {
  template <class S>
  using Method = cambium::TVDRK2<S>;
};
struct UseTVDRK3 {
  template <class S>
  using Method = cambium::TVDRK3<S>;
};
struct UseRK4 {
  template <class S>
  using Method = cambium::RK4<S>;
};
using Monotone = std::tuple<UseEuler, UseTVDRK2, UseTVDRK3>;
using All = std::tuple<UseEuler, UseTVDRK2, UseTVDRK3, UseRK4>;
using Numbers = std::vector<double>;

/// Error at t = 1 of y' = -2 t y^2, y(0) = 1, whose solution is 1 / (1 + t^2).
template <class M>
double ode_error(int steps) {
  typename M::template Method<Numbers> stepper;
  Numbers y{1.0};
  const double dt = 1.0 / steps;
  for (int n = 0; n < steps; ++n) {
    stepper.step(y, n * dt, dt, [](const Numbers& at, double t, Numbers& d) { d[0] = -2.0 * t * at[0] * at[0]; });
  }
  return std::abs(y[0] - 0.5);
}

/// Largest error of particles that circle the last axis at the angular velocity 1 + r^2, after a time of 1.
template <class M, int D>
double rotation_error(int steps) {
  cambium::Particles<D> particles(7);
  for (std::size_t p = 0; p < particles.size(); ++p) {
    particles.positions().set(p, Vec<D>::unit(0, 0.1 + 0.1 * static_cast<double>(p)));
  }
  typename M::template Method<Columns<D, double>> stepper;
  const double dt = 1.0 / steps;
  for (int n = 0; n < steps; ++n) {
    stepper.step(particles.positions(), n * dt, dt, [](Columns<D, const double> x, double, Columns<D, double> u) {
      for (std::size_t p = 0; p < x.size(); ++p) {
        const double rate = 1.0 + dot(x[p], x[p]);
        Vec<D> velocity;
        velocity[0] = -rate * x[p][1];
        velocity[1] = rate * x[p][0];
        u.set(p, velocity);
      }
    });
  }
  double error = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double r = 0.1 + 0.1 * static_cast<double>(p);
    Vec<D> exact;
    exact[0] = r * std::cos(1.0 + r * r);
    exact[1] = r * std::sin(1.0 + r * r);
    error = std::max(error, norm(particles.positions()[p] - exact));
  }
  return error;
}

/// |R(z)| of one step of y' = z y, z = real + i imaginary.
template <class M>
double amplification(double real, double imaginary) {
  typename M::template Method<Numbers> stepper;
  Numbers y{1.0, 0.0};
  stepper.step(y, 0.0, 1.0, [&](const Numbers& at, double, Numbers& d) {
    d[0] = real * at[0] - imaginary * at[1];
    d[1] = real * at[1] + imaginary * at[0];
  });
  return std::hypot(y[0], y[1]);
}

double total_variation(const Numbers& u) {
  double sum = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) sum += std::abs(u[i] - u[i > 0 ? i - 1 : u.size() - 1]);
  return sum;
}

}  // namespace

// Theory: the global error falls with the order of the method; at these step sizes the measured order is within 0.1.
BOOST_AUTO_TEST_CASE_TEMPLATE(order_on_a_nonlinear_equation, M, All) {
  const double order = support::observed_order(ode_error<M>(32), ode_error<M>(64));
  BOOST_TEST_MESSAGE("measured order " << order);
  BOOST_TEST(std::abs(order - M::template Method<Numbers>::order) < 0.1);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(order_on_particles_in_a_rotating_flow, M, All) {
  const double flat = support::observed_order(rotation_error<M, 2>(64), rotation_error<M, 2>(128));
  const double solid = support::observed_order(rotation_error<M, 3>(64), rotation_error<M, 3>(128));
  BOOST_TEST_MESSAGE("measured order " << flat << ", " << solid);
  BOOST_TEST(std::abs(flat - M::template Method<Numbers>::order) < 0.15);
  BOOST_TEST(std::abs(solid - M::template Method<Numbers>::order) < 0.15);
}

// The stated ends of the stability interval: |R| = 1 there, above 1 just beyond.
BOOST_AUTO_TEST_CASE_TEMPLATE(stability_bounds_are_those_of_the_method, M, All) {
  using Method = typename M::template Method<Numbers>;
  BOOST_TEST(amplification<M>(-Method::real_axis, 0.0) <= 1.0 + 1e-9);
  BOOST_TEST(amplification<M>(-1.001 * Method::real_axis, 0.0) > 1.0);
  BOOST_TEST(amplification<M>(0.0, Method::imaginary_axis) <= 1.0 + 1e-9);
  BOOST_TEST(amplification<M>(0.0, 1.001 * Method::imaginary_axis + 0.01) > 1.0);
}

// Upwind differences of Burgers' equation for positive data keep the total variation under Euler up to dt |u|max = h.
// Methods with ssp = 1 inherit this, to round-off (1e-13 leaves 200 additions of numbers near 1).
BOOST_AUTO_TEST_CASE_TEMPLATE(no_new_extrema_where_euler_makes_none, M, Monotone) {
  using Method = typename M::template Method<Numbers>;
  const std::size_t n = 100;
  const double dt = Method::ssp / static_cast<double>(n);
  Numbers u(n, 0.0);
  for (std::size_t i = 20; i < 50; ++i) u[i] = i % 10 < 5 ? 1.0 : 0.25;
  Method stepper(u);
  for (int step = 0; step < 100; ++step) {
    const double before = total_variation(u);
    stepper.step(u, 0.0, dt, [&](const Numbers& at, double, Numbers& d) {
      for (std::size_t i = 0; i < n; ++i) {
        const double upwind = at[i > 0 ? i - 1 : n - 1];
        d[i] = -0.5 * (at[i] * at[i] - upwind * upwind) * static_cast<double>(n);
      }
    });
    BOOST_TEST(total_variation(u) <= before + 1e-13);
    for (const double value : u) BOOST_TEST((value >= -1e-15 && value <= 1.0 + 1e-15));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(bad_steps_are_refused_and_change_nothing, M, All) {
  typename M::template Method<Numbers> stepper;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  Numbers y{1.0, 2.0};
  const auto rhs = [](const Numbers& at, double, Numbers& d) { d = at; };
  for (const double dt : {0.0, -0.1, nan, infinity}) {
    BOOST_CHECK_EXCEPTION(stepper.step(y, 0.0, dt, rhs), cambium::ValueError,
                          [](const cambium::ValueError& e) { return std::string(e.what()).find("time step is") == 0; });
  }
  BOOST_CHECK_THROW(stepper.step(y, nan, 0.1, rhs), cambium::ValueError);
  BOOST_CHECK_THROW(stepper.step(y, 0.0, 0.1, [](const Numbers&, double, Numbers& d) { d.resize(1); }),
                    cambium::SizeError);
  int calls = 0;
  const int stages = M::template Method<Numbers>::stages;
  const auto fails_at_the_last_stage = [&](const Numbers& at, double, Numbers& d) {
    d = at;
    if (++calls == stages) throw std::runtime_error("stop");
  };
  BOOST_CHECK_THROW(stepper.step(y, 0.0, 0.1, fails_at_the_last_stage), std::runtime_error);
  BOOST_TEST(y == (Numbers{1.0, 2.0}));
  stepper.step(y, 0.0, 0.1, rhs);
  BOOST_TEST(y[0] > 1.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(buffers_are_made_once_and_follow_the_size, M, All) {
  Numbers y(10, 1.0);
  typename M::template Method<Numbers> stepper(y);
  std::set<const double*> places;
  const auto rhs = [&](const Numbers& at, double, Numbers& d) {
    BOOST_TEST(d.size() == at.size());
    places.insert(d.data());
    for (std::size_t i = 0; i < d.size(); ++i) d[i] = at[i];
  };
  stepper.step(y, 0.0, 0.1, rhs);
  const auto first = places;
  for (int n = 1; n < 5; ++n) stepper.step(y, 0.1 * n, 0.1, rhs);
  BOOST_TEST((places == first));
  y.resize(1000, 1.0);
  stepper.step(y, 0.5, 0.1, rhs);
}

BOOST_AUTO_TEST_CASE(threads_do_not_change_a_bit) {
  const auto run = [](int threads) {
    Numbers y(20000);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = std::sin(static_cast<double>(i));
    cambium::RK4 rk4(y, cambium::OpenMP{threads});
    cambium::TVDRK3 rk3(y, cambium::OpenMP{threads});
    const auto rhs = [](const Numbers& at, double t, Numbers& d) {
      for (std::size_t i = 0; i < at.size(); ++i) d[i] = std::cos(t) - at[i] * at[i];
    };
    for (int n = 0; n < 3; ++n) {
      rk4.step(y, n * 0.1, 0.05, rhs);
      rk3.step(y, n * 0.1 + 0.05, 0.05, rhs);
    }
    return y;
  };
  const Numbers one = run(1);
  BOOST_TEST((run(2) == one));
  BOOST_TEST((run(3) == one));
}
