// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE differences
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstring>
#include <numbers>
#include <tuple>

#include <cambium/operators/differences.hpp>

#include "support/order.hpp"

using namespace cambium;

namespace {

template <int Order_, int D_>
struct Case {
  static constexpr int order = Order_;
  static constexpr int dimension = D_;
};

using Cases = std::tuple<Case<2, 1>, Case<4, 1>, Case<6, 1>, Case<2, 2>, Case<4, 2>, Case<6, 2>, Case<4, 3>>;
using LowOrders = std::tuple<CentredDifference<2>, CentredDifference<4>>;
using Scalars = std::tuple<float, double>;

template <int D>
Lattice<D> lattice_of(bool periodic, std::ptrdiff_t cells) {
  return periodic ? Lattice<D>::periodic_box(Box<D>::cube(), cells) : Lattice<D>::bounded_box(Box<D>::cube(), cells);
}

/// sin(k . x + phase): smooth and periodic in the unit box for whole multiples of 2 pi.
template <int D>
struct Wave {
  Vec<D> k;
  double phase;

  double value(const Vec<D>& x) const { return std::sin(dot(k, x) + phase); }
  double derivative(const Vec<D>& x, int d) const { return k[d] * std::cos(dot(k, x) + phase); }
  double laplacian(const Vec<D>& x) const { return -dot(k, k) * value(x); }
};

/// One wave for each component; 2 pi times small whole numbers, different along every axis.
template <int D>
Wave<D> wave(int component) {
  Wave<D> result{{}, 0.3 + 0.7 * component};
  for (int d = 0; d < D; ++d) result.k[d] = 2.0 * std::numbers::pi * ((d + component) % 2 == 0 ? 1.0 : -1.0);
  return result;
}

template <int D>
Field<Vec<D>, D> wave_field(const Lattice<D>& lattice) {
  return sample(lattice, [](const Vec<D>& x) {
    Vec<D> u;
    for (int c = 0; c < D; ++c) u[c] = wave<D>(c).value(x);
    return u;
  });
}

template <class V, int D, class F>
double max_error(const Field<V, D>& field, F&& exact) {
  double error = 0.0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const V difference = field[i] - exact(field.lattice().position(field.lattice().node(i)));
    for (int c = 0; c < Components<V>::count; ++c) {
      error = std::max(error, static_cast<double>(std::abs(component(difference, c))));
    }
  }
  return error;
}

struct Errors {
  double gradient, divergence, laplacian, curl, second;
};

template <int D>
double curl_error(const Field<Vec<D>, D>& u, auto differences) {
  if constexpr (D == 2) {
    Field<double, 2> out(u.lattice());
    decltype(differences)::curl(u, out);
    return max_error(out, [](const Vec<2>& x) { return wave<2>(1).derivative(x, 0) - wave<2>(0).derivative(x, 1); });
  } else if constexpr (D == 3) {
    Field<Vec<3>, 3> out(u.lattice());
    decltype(differences)::curl(u, out);
    return max_error(out, [](const Vec<3>& x) {
      return Vec<3>{wave<3>(2).derivative(x, 1) - wave<3>(1).derivative(x, 2),
                    wave<3>(0).derivative(x, 2) - wave<3>(2).derivative(x, 0),
                    wave<3>(1).derivative(x, 0) - wave<3>(0).derivative(x, 1)};
    });
  } else {
    return 0.0;
  }
}

template <class C>
Errors errors(bool periodic, std::ptrdiff_t cells) {
  constexpr int D = C::dimension;
  using Differences = CentredDifference<C::order>;
  const auto lattice = lattice_of<D>(periodic, cells);
  const auto scalar = sample(lattice, [](const Vec<D>& x) { return wave<D>(0).value(x); });
  Field<detail::ValueOf<D, double>, D> gradient(lattice);
  Field<double, D> result(lattice);
  Errors e{};
  Differences::gradient(scalar, gradient);
  e.gradient = max_error(gradient, [](const Vec<D>& x) {
    detail::ValueOf<D, double> exact{};
    for (int d = 0; d < D; ++d) component(exact, d) = wave<D>(0).derivative(x, d);
    return exact;
  });
  Differences::laplacian(scalar, result);
  e.laplacian = max_error(result, [](const Vec<D>& x) { return wave<D>(0).laplacian(x); });
  Differences::second_derivative(scalar, D - 1, result);
  e.second = max_error(
      result, [](const Vec<D>& x) { return -wave<D>(0).k[D - 1] * wave<D>(0).k[D - 1] * wave<D>(0).value(x); });
  const auto u = wave_field<D>(lattice);
  Differences::divergence(u, result);
  e.divergence = max_error(result, [](const Vec<D>& x) {
    double sum = 0.0;
    for (int d = 0; d < D; ++d) sum += wave<D>(d).derivative(x, d);
    return sum;
  });
  e.curl = curl_error<D>(u, Differences{});
  return e;
}

template <class V, int D, class S>
bool same_bits(const Field<V, D, S>& a, const Field<V, D, S>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(V)) == 0;
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(order_of_convergence, C, Cases) {
  for (const bool periodic : {true, false}) {
    // One-sided stencils of order 6 reach their order only where 2 pi h * 7 < 1; 3D stays affordable.
    const std::ptrdiff_t cells = C::dimension == 3 ? 24 : C::order == 6 && !periodic ? 48 : 32;
    const Errors coarse = errors<C>(periodic, cells);
    const Errors fine = errors<C>(periodic, 2 * cells);
    // 0.2 below the order is the tolerance of all order tests of the library.
    BOOST_TEST(support::observed_order(coarse.gradient, fine.gradient) > C::order - 0.2);
    BOOST_TEST(support::observed_order(coarse.divergence, fine.divergence) > C::order - 0.2);
    BOOST_TEST(support::observed_order(coarse.laplacian, fine.laplacian) > C::order - 0.2);
    BOOST_TEST(support::observed_order(coarse.second, fine.second) > C::order - 0.2);
    if (C::dimension > 1) BOOST_TEST(support::observed_order(coarse.curl, fine.curl) > C::order - 0.2);
    // The order is the declared one, not a higher one by accident of the test function.
    if (periodic) BOOST_TEST(support::observed_order(coarse.gradient, fine.gradient) < C::order + 0.2);
  }
}

BOOST_AUTO_TEST_CASE(polynomials_of_the_order_are_exact_up_to_the_faces) {
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 12);
  const auto power = [](double x, int n) { return std::pow(x, n); };
  const auto f = sample(lattice, [&](const Vec<2>& x) { return power(x[0], 6) + 2.0 * power(x[1], 5) * x[0]; });
  Field<Vec<2>, 2> gradient(lattice);
  Field<double, 2> laplacian(lattice);
  CentredDifference<6>::gradient(f, gradient);
  CentredDifference<6>::laplacian(f, laplacian);
  // Round-off: one-sided weights sum to 1e2 / h^2 in absolute value, times 1e-16.
  BOOST_TEST(max_error(gradient, [&](const Vec<2>& x) {
               return Vec<2>{6.0 * power(x[0], 5) + 2.0 * power(x[1], 5), 10.0 * power(x[1], 4) * x[0]};
             }) < 1e-12);
  BOOST_TEST(max_error(laplacian,
                       [&](const Vec<2>& x) { return 30.0 * power(x[0], 4) + 40.0 * power(x[1], 3) * x[0]; }) < 1e-10);
}

BOOST_AUTO_TEST_CASE(constants_give_exactly_zero) {
  const auto lattice = Lattice<3>::bounded_box(Box<3>::cube(), 9);
  const Field<double, 3> f(lattice, 0.1);
  Field<Vec<3>, 3> gradient(lattice, Vec<3>::constant(1.0));
  Field<double, 3> laplacian(lattice, 1.0);
  CentredDifference<6>::gradient(f, gradient);
  CentredDifference<6>::laplacian(f, laplacian);
  BOOST_TEST(max_error(gradient, [](const Vec<3>&) { return Vec<3>{}; }) == 0.0);
  BOOST_TEST(max_error(laplacian, [](const Vec<3>&) { return 0.0; }) == 0.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(periodic_identities, O, LowOrders) {
  const auto lattice = Lattice<3>::periodic_box(Box<3>::cube(), 10);
  const auto u = sample(lattice, [](const Vec<3>& x) {
    return Vec<3>{std::sin(17.0 * x[1] + x[0]), std::cos(9.0 * x[2] * x[0]), std::exp(x[0] * x[1])};
  });
  Field<Vec<3>, 3> curl(lattice);
  Field<double, 3> divergence(lattice);
  O::curl(u, curl);
  O::divergence(curl, divergence);
  // Differences along different axes commute: div curl vanishes to the round-off of 1 / h^2 = 100.
  BOOST_TEST(max_error(divergence, [](const Vec<3>&) { return 0.0; }) < 1e-12);
  // Summation by parts: the first derivative is skew, sum_i f D g = - sum_i g D f.
  Field<Vec<3>, 3> du(lattice);
  O::derivative(u, 2, du);
  double skew = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) skew += u[i][0] * du[i][1] + u[i][1] * du[i][0];
  BOOST_TEST(std::abs(skew) < 1e-10);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(threads_do_not_change_a_bit, T, Scalars) {
  const auto lattice = Lattice<3>({{0, 0, 0}, {1, 1, 1}}, 1.0 / 18, {true, false, true});
  Field<T, 3> f(lattice);
  f.sample([](const Vec<3>& x) { return static_cast<T>(std::sin(5.0 * x[0] + 3.0 * x[1] * x[2])); });
  Field<T, 3> one(lattice), two(lattice), three(lattice), serial(lattice);
  CentredDifference<4>::laplacian(f, serial, Serial{});
  CentredDifference<4>::laplacian(f, one, OpenMP{1});
  CentredDifference<4>::laplacian(f, two, OpenMP{2});
  CentredDifference<4>::laplacian(f, three, OpenMP{3});
  BOOST_TEST(same_bits(serial, one));
  BOOST_TEST(same_bits(serial, two));
  BOOST_TEST(same_bits(serial, three));
}

BOOST_AUTO_TEST_CASE(float_agrees_with_double) {
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 20);
  const auto f = sample(lattice, [](const Vec<2>& x) { return std::sin(5.0 * x[0] + 3.0 * x[1]); });
  Field<float, 2> single(lattice), single_out(lattice);
  for (std::size_t i = 0; i < f.size(); ++i) single[i] = static_cast<float>(f[i]);
  Field<double, 2> out(lattice);
  CentredDifference<4>::laplacian(f, out);
  CentredDifference<4>::laplacian(single, single_out);
  double error = 0.0;
  for (std::size_t i = 0; i < f.size(); ++i)
    error = std::max(error, std::abs(out[i] - static_cast<double>(single_out[i])));
  // Rounding of the input, 6e-8, times the absolute sum of one-sided weights, 2 * 15 / h^2 = 12000.
  BOOST_TEST(error < 1e-3);
}

template <int D>
void compare_sparse_and_dense(const Lattice<D>& lattice) {
  const auto u = wave_field<D>(lattice);
  Field<Vec<D>, D, Sparse> sparse(lattice);
  for (std::size_t i = 0; i < u.size(); ++i) sparse.set(lattice.node(i), u[i]);
  Field<double, D> dense_out(lattice);
  Field<double, D, Sparse> sparse_out(lattice);
  CentredDifference<4>::divergence(u, dense_out);
  CentredDifference<4>::divergence(sparse, sparse_out);
  BOOST_TEST(sparse_out.blocks() == sparse.blocks());
  double error = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    error = std::max(error, std::abs(dense_out[i] - sparse_out(lattice.node(i))));
  }
  BOOST_TEST(error < 1e-12);  // values of size 2 pi, the same sums in another order
}

BOOST_AUTO_TEST_CASE(sparse_equals_dense_where_all_blocks_are_active) {
  compare_sparse_and_dense(Lattice<2>({{0, 0}, {1, 1}}, 1.0 / 37, {true, false}));
  compare_sparse_and_dense(Lattice<3>({{0, 0, 0}, {1, 1, 1}}, 1.0 / 17, {false, true, true}));
}

BOOST_AUTO_TEST_CASE(sparse_results_live_on_the_active_blocks) {
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 100);
  Field<double, 2, Sparse> f(lattice, 7.0), out(lattice, -1.0);
  f.set({40, 40}, 8.0);
  out.activate({0, 0});
  CentredDifference<2>::laplacian(f, out);
  BOOST_TEST(out.blocks() == 1u);
  BOOST_TEST(out({40, 40}) == -4.0 * 100 * 100, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(out({41, 40}) == 1.0 * 100 * 100, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(out({0, 0}) == -1.0);
}

BOOST_AUTO_TEST_CASE(misuse_is_named) {
  const auto lattice = Lattice<2>::bounded_box(Box<2>::cube(), 8);
  Field<double, 2> f(lattice, 1.0), other(Lattice<2>::bounded_box(Box<2>::cube(), 9), 5.0), out(lattice, 5.0);
  BOOST_CHECK_THROW(CentredDifference<2>::laplacian(f, other), SizeError);
  BOOST_TEST(other[3] == 5.0);
  BOOST_CHECK_THROW(CentredDifference<2>::laplacian(f, f), ValueError);
  BOOST_CHECK_THROW(CentredDifference<2>::derivative(f, 2, out), ValueError);
  BOOST_CHECK_THROW(CentredDifference<2>::derivative(f, -1, out), ValueError);
  Field<double, 2> small(Lattice<2>::bounded_box(Box<2>::cube(), 6)), small_out(small.lattice(), 5.0);
  BOOST_CHECK_THROW(CentredDifference<6>::laplacian(small, small_out), LatticeError);  // 7 nodes, 8 needed
  BOOST_TEST(small_out[0] == 5.0);
  Field<double, 2> ring(Lattice<2>::periodic_box(Box<2>::cube(), 7)), ring_out(ring.lattice());
  BOOST_CHECK_NO_THROW(CentredDifference<6>::laplacian(ring, ring_out));
}
