// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE pse
#include <boost/test/unit_test.hpp>
#include <limits>
#include <tuple>

#include <cambium/core/field.hpp>
#include <cambium/kernels/constant_math.hpp>
#include <cambium/kernels/gaussian_pse.hpp>
#include <cambium/operators/pse.hpp>

#include "support/cloud.hpp"

using namespace cambium;
using support::Arrays;
using support::Cloud;
using support::Wave;

namespace {

template <class Kernel_, int D_>
struct Case {
  using Kernel = Kernel_;
  static constexpr int dimension = D_;
};
using Cases = std::tuple<Case<Gaussian2, 1>, Case<Gaussian4, 2>, Case<Gaussian6, 2>>;

template <int D>
const Domain<D> unit_box = Domain<D>::periodic_box(Box<D>::cube());

}  // namespace

// Errors of Lap_eps sin + sin and d_eps sin - cos on a 2 pi periodic lattice with h / eps = 1/2: one minus the kernel's
// Fourier symbol, 4 exp(-z) sum_{j <= n} (n + 1 - j) z^j / j! with z = eps^2 / 4, computed in 40 digits.
BOOST_AUTO_TEST_CASE(errors_are_the_known_ones) {
  struct Row {
    int n;
    std::array<double, 3> laplacian, derivative;
  };
  const Row rows[] = {{32, {1.903e-2, 2.430e-4, 2.333e-6}, {3.782e-2, 7.243e-4, 9.279e-6}},
                      {64, {4.804e-3, 1.541e-5, 3.709e-8}, {9.592e-3, 4.615e-5, 1.482e-7}},
                      {128, {1.204e-3, 9.665e-7, 5.831e-10}, {2.407e-3, 2.898e-6, 2.328e-9}}};
  const auto check = [](auto kernel, const Row& row, std::size_t k) {
    const double h = 2.0 * std::numbers::pi / row.n;
    std::vector<double> x(row.n), v(row.n, h), q(row.n), laplacian(row.n), derivative(row.n);
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] = static_cast<double>(i) * h;
      q[i] = std::sin(x[i]);
    }
    const auto domain = Domain<1>::periodic_box(Box<1>::cube(2.0 * std::numbers::pi));
    const auto op = PSE<decltype(kernel)>(2.0 * h).at(domain, x, v);
    op.laplacian(q, laplacian, OfValues{});
    op.gradient(q, derivative, OfValues{});
    double laplacian_error = 0.0, derivative_error = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      laplacian_error = std::max(laplacian_error, std::abs(laplacian[i] + q[i]));
      derivative_error = std::max(derivative_error, std::abs(derivative[i] - std::cos(x[i])));
    }
    // Four digits of the table, and round-off of 1e-16 times M_0 / eps^2 = 1e3.
    BOOST_TEST(std::abs(laplacian_error - row.laplacian[k]) < 6e-4 * row.laplacian[k] + 1e-12);
    BOOST_TEST(std::abs(derivative_error - row.derivative[k]) < 6e-4 * row.derivative[k] + 1e-12);
  };
  for (const Row& row : rows) {
    check(Gaussian2{}, row, 0);
    check(Gaussian4{}, row, 1);
    check(Gaussian6{}, row, 2);
  }
}

// Moments sum_j h eta_eps, sum_j h eta_eps z^2, sum_j h eta_eps z^4 over a lattice, computed in 40 digits: where they
// are not 4 n, 2 and 0 (3 for order 2) the error does not fall with eps.
BOOST_AUTO_TEST_CASE(lattice_moments_are_the_known_ones) {
  struct Row {
    double overlap;
    std::array<double, 3> mass, second, fourth;
  };
  const Row rows[] = {{0.5, {4.0, 8.0, 12.0}, {2.0, 2.0, 2.0}, {3.000, 0.0, 0.0}},
                      {0.8,
                       {4.0000016059, 8.0000279771, 12.0002453040},
                       {1.9999760377, 1.9996312741, 1.9971638856},
                       {3.000, 4.073e-3, 2.647e-2}},
                      {1.0,
                       {4.0004137855, 8.0049114701, 12.0295623889},
                       {1.9961229937, 1.9619423739, 1.8134210103},
                       {3.028, 0.2116, 0.7471}},
                      {1.25,
                       {4.0144493584, 8.1201687669, 12.5141439684},
                       {1.9159546290, 1.4763481184, 0.3762058746},
                       {3.314, 1.101, 1.278}}};
  const auto check = [](auto kernel, const Row& row, std::size_t k) {
    const int reach = 20;
    std::vector<double> x, v(2 * reach + 1, row.overlap), square, fourth, out(v.size());
    for (int j = -reach; j <= reach; ++j) {
      x.push_back(row.overlap * j);  // epsilon = 1
      square.push_back(x.back() * x.back());
      fourth.push_back(square.back() * square.back());
    }
    const auto op = PSE<decltype(kernel)>(1.0).at(Domain<1>::bounded_box({{-30.0}, {30.0}}), x, v);
    const auto ring = Domain<1>::periodic_box({{-(reach + 0.5) * row.overlap}, {(reach + 0.5) * row.overlap}});
    const auto closed = PSE<decltype(kernel)>(1.0, std::min(kernel.cutoff, reach * row.overlap)).at(ring, x, v);
    BOOST_TEST(std::abs(2.0 / closed.stable_step(1.0) - row.mass[k]) < 1e-9);
    op.laplacian(square, out, OfValues{});
    BOOST_TEST(std::abs(out[reach] - row.second[k]) < 1e-9);
    op.laplacian(fourth, out, OfValues{});
    BOOST_TEST(std::abs(out[reach] - row.fourth[k]) < 6e-4 * std::max(1e-6, row.fourth[k]));
  };
  for (const Row& row : rows) {
    check(Gaussian2{}, row, 0);
    check(Gaussian4{}, row, 1);
    check(Gaussian6{}, row, 2);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(on_a_lattice_it_is_a_finite_difference_scheme, C, Cases) {
  constexpr int D = C::dimension;
  using Kernel = typename C::Kernel;
  const int n = 30;
  const auto lattice = Lattice<D>::periodic_box(Box<D>::cube(), n);
  const double h = lattice.spacing();
  const double epsilon = 2.0 * h;
  const auto q =
      sample(lattice, [](const Vec<D>& x) { return std::exp(std::sin(2.0 * std::numbers::pi * x[0])) + x[D - 1]; });
  // The stencil with coefficients h^D eps^-2 eta_eps, written with integer offsets alone.
  Field<double, D> stencil(lattice);
  const int reach = static_cast<int>(Kernel::cutoff * 2.0);
  for (std::size_t i = 0; i < q.size(); ++i) {
    double sum = 0.0;
    for (int a = -reach; a <= reach; ++a) {
      for (int b = D > 1 ? -reach : 0; b <= (D > 1 ? reach : 0); ++b) {
        const double rho2 = (a * a + b * b) / 4.0;
        if (rho2 > Kernel::cutoff * Kernel::cutoff) continue;
        Index<D> other = lattice.node(i);
        other[0] = lattice.wrap(0, other[0] + a);
        if (D > 1) other[D - 1] = lattice.wrap(D - 1, other[D - 1] + b);
        sum += std::pow(h / epsilon, D) / (epsilon * epsilon) * Kernel::template laplacian<D>(rho2) * (q(other) - q[i]);
      }
    }
    stencil[i] = sum;
  }
  std::array<std::vector<double>, D> x;
  for (std::size_t i = 0; i < q.size(); ++i) {
    for (int d = 0; d < D; ++d) x[d].push_back(lattice.position(lattice.node(i))[d]);
  }
  std::array<std::span<const double>, D> spans;
  for (int d = 0; d < D; ++d) spans[d] = x[d];
  const std::vector<double> volume(q.size(), lattice.cell_volume());
  std::vector<double> out(q.size());
  PSE<Kernel>(epsilon)
      .at(lattice.domain(), Columns<D, const double>(spans), volume)
      .laplacian(q.values(), out, OfValues{});
  double difference = 0.0;
  for (std::size_t i = 0; i < q.size(); ++i) difference = std::max(difference, std::abs(out[i] - stencil[i]));
  // Round-off: M_0 / eps^2 = 12 * 225 times values of 3 times a few 1e-16.
  BOOST_TEST(difference < 1e-11);
}

BOOST_AUTO_TEST_CASE(stored_pairs_give_the_same_as_evaluated_ones) {
  const auto cloud = support::disorderly_cloud<2>(24);
  const PSE<Gaussian4> pse(1.5 * cloud.spacing);
  const auto evaluated = pse.at(unit_box<2>, cloud.positions(), cloud.volume);
  const auto stored = pse.stored_at(unit_box<2>, cloud.positions(), cloud.volume);
  std::vector<double> a(cloud.size()), b(cloud.size());
  Arrays<2> ga(cloud.size()), gb(cloud.size());
  const auto& strength = cloud.x[0];
  const auto difference = [&](const std::vector<double>& s, const std::vector<double>& t) {
    double result = 0.0;
    for (std::size_t p = 0; p < s.size(); ++p) result = std::max(result, std::abs(s[p] - t[p]));
    return result;
  };
  // Round-off of sums whose terms are M_0 / eps^2 = 2000 times a volume of 1/300 and more.
  evaluated.laplacian(strength, a);
  stored.laplacian(strength, b);
  BOOST_TEST(difference(a, b) < 1e-12);
  evaluated.gradient(strength, ga.columns());
  stored.gradient(strength, gb.columns());
  BOOST_TEST(difference(ga.array[0], gb.array[0]) < 1e-12);
  evaluated.diffusion(SymmetricTensor<2>{1.0, 0.5, 2.0}, strength, a);
  stored.diffusion(SymmetricTensor<2>{1.0, 0.5, 2.0}, strength, b);
  BOOST_TEST(difference(a, b) < 1e-12);
  BOOST_TEST(evaluated.stable_step(2.0) == stored.stable_step(2.0), boost::test_tools::tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(threads_do_not_change_a_bit) {
  const auto cloud = support::disorderly_cloud<2>(24);
  const PSE<Gaussian4> pse(1.5 * cloud.spacing);
  const auto run = [&](const auto& execution) {
    const auto op = pse.at(unit_box<2>, cloud.positions(), cloud.volume, execution);
    const auto stored = pse.stored_at(unit_box<2>, cloud.positions(), cloud.volume, execution);
    std::vector<double> out(4 * cloud.size());
    const auto part = [&](std::size_t i) { return std::span(out).subspan(i * cloud.size(), cloud.size()); };
    op.laplacian(cloud.x[0], part(0));
    stored.laplacian(cloud.x[0], part(1));
    op.gradient(cloud.x[0], Columns<2, double>(std::array{part(2), part(3)}));
    return std::pair(out, op.stable_step(1.0));
  };
  const auto serial = run(Serial{});
  BOOST_TEST((run(OpenMP{1}) == serial));
  BOOST_TEST((run(OpenMP{2}) == serial));
  BOOST_TEST((run(OpenMP{3}) == serial));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(explicit_euler_is_stable_up_to_the_limit, C, Cases) {
  constexpr int D = C::dimension;
  const auto cloud = support::lattice_cloud<D>(28);
  const PSE<typename C::Kernel> pse(2.0 * cloud.spacing);
  const auto op = pse.stored_at(unit_box<D>, cloud.positions(), cloud.volume);
  BOOST_TEST(op.stable_step(0.7) == pse.template stable_step<D>(0.7), boost::test_tools::tolerance(1e-8));
  const auto grown = [&](double factor) {
    std::vector<double> q(cloud.size()), rate(cloud.size());
    for (std::size_t p = 0; p < q.size(); ++p) q[p] = p % 2 == 0 ? 1.0 : -1.0;  // the fastest mode: +, -, +, -
    const double dt = factor * op.stable_step(1.0);
    for (int step = 0; step < 100; ++step) {
      op.laplacian(q, rate, OfValues{});
      for (std::size_t p = 0; p < q.size(); ++p) q[p] += dt * rate[p];
    }
    return std::abs(q[0]);
  };
  // Growth per step 1 - 2 factor (1 - eta_hat / M_0), and eta_hat(pi / h) < 1e-2 M_0 here.
  BOOST_TEST(grown(0.999) < 1.01);
  BOOST_TEST(grown(1.05) > 100.0);
}

/// A user's kernel: the heat kernel at time 1, Gaussian2 with twice the width.
struct HeatKernel {
  static constexpr int order = 2;
  static constexpr double cutoff = 12.4;
  static constexpr double largest_spacing = 1.6;
  template <int D>
  static constexpr double zeroth_moment = 1.0;
  template <int D>
  static constexpr double laplacian(double rho2) {
    double result = exponential(-0.25 * rho2);
    for (int d = 0; d < D; ++d) result *= 0.5 * std::numbers::inv_sqrtpi;
    return result;
  }
  template <int D>
  static constexpr double gradient(double rho2) {
    return -0.5 * laplacian<D>(rho2);
  }
};

BOOST_AUTO_TEST_CASE(a_users_kernel_gives_the_same_operators) {
  const auto cloud = support::disorderly_cloud<2>(24);
  const auto ours = PSE<Gaussian2>(1.5 * cloud.spacing).at(unit_box<2>, cloud.positions(), cloud.volume);
  const auto theirs = PSE<HeatKernel>(0.75 * cloud.spacing).at(unit_box<2>, cloud.positions(), cloud.volume);
  std::vector<double> a(cloud.size()), b(cloud.size());
  ours.laplacian(cloud.x[0], a);
  theirs.laplacian(cloud.x[0], b);
  for (std::size_t p = 0; p < a.size(); ++p) BOOST_TEST(std::abs(a[p] - b[p]) < 1e-12);
  ours.diffusion(isotropic_tensor<2>(1.0), cloud.x[0], a);
  theirs.diffusion(isotropic_tensor<2>(1.0), cloud.x[0], b);
  for (std::size_t p = 0; p < a.size(); ++p) BOOST_TEST(std::abs(a[p] - b[p]) < 1e-12);
}

BOOST_AUTO_TEST_CASE(float_particles_agree_with_double_ones) {
  const auto single = support::lattice_cloud<2, float>(32);
  const auto cloud = support::lattice_cloud<2>(32);
  std::vector<float> q(single.size()), out(single.size());
  for (std::size_t p = 0; p < q.size(); ++p) q[p] = static_cast<float>(Wave<2>::component(0).value(cloud.position(p)));
  PSE<Gaussian2>(2.0 / 32).at(unit_box<2>, single.positions(), single.volume).laplacian(q, out, OfValues{});
  // Values rounded to 6e-8 under weights of M_0 / eps^2 = 1024, positions too; the kernel's error is 2 pi^2 / 100.
  std::vector<double> exact(cloud.size());
  std::vector<double> values(q.begin(), q.end());
  PSE<Gaussian2>(2.0 / 32).at(unit_box<2>, cloud.positions(), cloud.volume).laplacian(values, exact, OfValues{});
  for (std::size_t p = 0; p < q.size(); ++p) BOOST_TEST(std::abs(static_cast<double>(out[p]) - exact[p]) < 1e-3);
}

BOOST_AUTO_TEST_CASE(misuse_is_named) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_THROW(PSE<Gaussian2>(0.0), ValueError);
  BOOST_CHECK_THROW(PSE<Gaussian2>{nan}, ValueError);
  BOOST_CHECK_THROW(PSE<Gaussian2>(1.0, -1.0), ValueError);
  const auto cloud = support::lattice_cloud<1>(32);
  const PSE<Gaussian2> pse(2.0 * cloud.spacing);
  auto volume = cloud.volume;
  volume[5] = -1.0;
  BOOST_CHECK_THROW(pse.at(unit_box<1>, cloud.positions(), volume), ValueError);
  volume[5] = nan;
  BOOST_CHECK_THROW(pse.at(unit_box<1>, cloud.positions(), volume), ValueError);
  volume.pop_back();
  BOOST_CHECK_THROW(pse.at(unit_box<1>, cloud.positions(), volume), SizeError);
  BOOST_CHECK_THROW(PSE<Gaussian2>(0.1).at(unit_box<1>, cloud.positions(), cloud.volume), ValueError);
  BOOST_CHECK_NO_THROW(PSE<Gaussian2>(0.1, 4.0).at(unit_box<1>, cloud.positions(), cloud.volume));
  auto outside = cloud;
  outside.x[0][3] = 1.5;
  const auto bounded = Domain<1>::bounded_box(Box<1>::cube());
  BOOST_CHECK_THROW(pse.at(bounded, outside.positions(), cloud.volume), PositionError);
  const auto op = pse.at(unit_box<1>, cloud.positions(), cloud.volume);
  std::vector<double> strength(32, 1.0), out(32, 5.0), shorter(31);
  BOOST_CHECK_THROW(op.laplacian(shorter, out), SizeError);
  BOOST_CHECK_THROW(op.laplacian(strength, shorter), SizeError);
  BOOST_CHECK_THROW(op.laplacian(strength, strength), ValueError);
  BOOST_CHECK_THROW(op.diffusion(SymmetricTensor<1>{nan}, strength, out), ValueError);
  BOOST_CHECK_THROW(op.stable_step(0.0), ValueError);
  strength[7] = nan;
  BOOST_CHECK_THROW(op.laplacian(strength, out), ValueError);
  BOOST_TEST((out == std::vector<double>(32, 5.0)));
}
