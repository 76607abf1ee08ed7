// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE pse_operator
#include <boost/test/unit_test.hpp>
#include <tuple>

#include <cambium/kernels/gaussian_pse.hpp>
#include <cambium/operators/pse.hpp>

#include "support/cloud.hpp"
#include "support/order.hpp"

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
using Cases = std::tuple<Case<Gaussian2, 1>, Case<Gaussian4, 1>, Case<Gaussian6, 1>, Case<Gaussian2, 2>,
                         Case<Gaussian4, 2>, Case<Gaussian6, 2>>;

template <int D>
const Domain<D> unit_box = Domain<D>::periodic_box(Box<D>::cube());

/// A diffusion tensor A + B sin(2 pi x_0 + 1), full and positive definite everywhere.
template <int D>
struct VariableTensor {
  static constexpr int count = D * (D + 1) / 2;
  static double a(int i, int j) { return i == j ? 1.0 + 0.5 * i : 0.3; }
  static double b(int i, int j) { return i == j ? 0.3 : 0.1; }
  static double wave(const Vec<D>& x) { return std::sin(2.0 * std::numbers::pi * x[0] + 1.0); }
  static double at(const Vec<D>& x, int i, int j) { return a(i, j) + b(i, j) * wave(x); }
  static Arrays<count> sample(const Cloud<D>& cloud) {
    Arrays<count> result(cloud.size());
    for (int i = 0, k = 0; i < D; ++i) {
      for (int j = i; j < D; ++j, ++k) {
        for (std::size_t p = 0; p < cloud.size(); ++p) result.array[k][p] = at(cloud.position(p), i, j);
      }
    }
    return result;
  }
  /// div(K grad q)
  static double apply(const Vec<D>& x, const Wave<D>& q) {
    const double slope = 2.0 * std::numbers::pi * std::cos(2.0 * std::numbers::pi * x[0] + 1.0);
    double sum = 0.0;
    for (int i = 0; i < D; ++i) {
      sum += b(0, i) * slope * q.derivative(x, i);
      for (int j = 0; j < D; ++j) sum += at(x, i, j) * q.derivative(x, i, j);
    }
    return sum;
  }
};

struct Errors {
  double laplacian, gradient, divergence, diffusion;
};

/// Errors of the values that strengths v q give, divided by the volumes again.
template <class Kernel, int D>
Errors errors(const Cloud<D>& cloud, double overlap, double cutoff = Kernel::cutoff) {
  const auto op = PSE<Kernel>(cloud.spacing / overlap, cutoff).at(unit_box<D>, cloud.positions(), cloud.volume);
  const auto q = Wave<D>::component(0);
  Arrays<D> u(cloud.size()), gradient(cloud.size());
  std::vector<double> out(cloud.size());
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    for (int d = 0; d < D; ++d) {
      u.array[d][p] = cloud.volume[p] * Wave<D>::component(d).value(cloud.position(p));
    }
  }
  const auto error = [&](std::vector<double> strength, auto&& exact) {
    for (std::size_t p = 0; p < cloud.size(); ++p) strength[p] /= cloud.volume[p];
    return support::max_error(cloud, strength, exact);
  };
  Errors e{};
  op.laplacian(u.array[0], out);
  e.laplacian = error(out, [&](const Vec<D>& x) { return q.laplacian(x); });
  op.gradient(u.array[0], gradient.columns());
  for (int d = 0; d < D; ++d) {
    e.gradient = std::max(e.gradient, error(gradient.array[d], [&](const Vec<D>& x) { return q.derivative(x, d); }));
  }
  op.divergence(u.columns(), out);
  e.divergence = error(out, [](const Vec<D>& x) {
    double sum = 0.0;
    for (int d = 0; d < D; ++d) sum += Wave<D>::component(d).derivative(x, d);
    return sum;
  });
  auto tensor = VariableTensor<D>::sample(cloud);
  op.diffusion(tensor.columns(), u.array[0], out);
  e.diffusion = error(out, [&](const Vec<D>& x) { return VariableTensor<D>::apply(x, q); });
  return e;
}

void check_orders(const Errors& coarse, const Errors& fine, int order, double ratio = 2.0) {
  // 0.2 is the tolerance of all order tests of the library.
  BOOST_TEST(support::observed_order(coarse.laplacian, fine.laplacian, ratio) > order - 0.2);
  BOOST_TEST(support::observed_order(coarse.gradient, fine.gradient, ratio) > order - 0.2);
  BOOST_TEST(support::observed_order(coarse.divergence, fine.divergence, ratio) > order - 0.2);
  BOOST_TEST(support::observed_order(coarse.diffusion, fine.diffusion, ratio) > order - 0.2);
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(order_on_lattices, C, Cases) {
  constexpr int D = C::dimension;
  const Errors coarse = errors<typename C::Kernel>(support::lattice_cloud<D>(32), 0.5);
  const Errors fine = errors<typename C::Kernel>(support::lattice_cloud<D>(64), 0.5);
  check_orders(coarse, fine, C::Kernel::order);
  BOOST_TEST(support::observed_order(coarse.laplacian, fine.laplacian) < C::Kernel::order + 0.2);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(order_on_displaced_particles_with_volumes, C, Cases) {
  constexpr int D = C::dimension;
  check_orders(errors<typename C::Kernel>(support::smooth_cloud<D>(32, 0.3), 0.5),
               errors<typename C::Kernel>(support::smooth_cloud<D>(64, 0.3), 0.5), C::Kernel::order);
}

BOOST_AUTO_TEST_CASE(order_in_three_dimensions) {
  // Order 2 may stand at h / eps = 0.8, where the lattice sum adds 1e-5 of the result; the cutoff leaves out 1e-6.
  const Errors coarse = errors<Gaussian2>(support::smooth_cloud<3>(14, 0.3), 0.8, 4.5);
  const Errors fine = errors<Gaussian2>(support::smooth_cloud<3>(21, 0.3), 0.8, 4.5);
  check_orders(coarse, fine, Gaussian2::order, 1.5);
}

template <int D, class Op>
void check_totals(const Op& op, const Cloud<D>& cloud) {
  Arrays<D> strength(cloud.size()), gradient(cloud.size());
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> value(0.1, 1.0);
  for (auto& array : strength.array) {
    for (double& s : array) s = value(generator);
  }
  const auto total = [](const std::vector<double>& array) {
    double sum = 0.0;
    for (const double a : array) sum += a;
    return sum;
  };
  // Rates are differences of terms of the size M_0 / eps^2 Q: totals vanish to round-off of those.
  const double rate = 2.0 / op.stable_step(1.0);
  const double scale = rate * total(strength.array[0]);
  std::vector<double> out(cloud.size());
  op.laplacian(strength.array[0], out);
  BOOST_TEST(std::abs(total(out)) < 1e-14 * scale);
  std::vector<double> stepped = strength.array[0];
  for (std::size_t p = 0; p < cloud.size(); ++p) stepped[p] += out[p] / rate;
  BOOST_TEST(std::abs(total(stepped) / total(strength.array[0]) - 1.0) < 1e-14);
  op.gradient(strength.array[0], gradient.columns());
  for (const auto& array : gradient.array) BOOST_TEST(std::abs(total(array)) < 1e-14 * scale);
  op.divergence(strength.columns(), out);
  BOOST_TEST(std::abs(total(out)) < 1e-14 * scale);
  auto tensor = VariableTensor<D>::sample(cloud);
  op.diffusion(tensor.columns(), strength.array[0], out);
  BOOST_TEST(std::abs(total(out)) < 1e-14 * scale);
}

using TotalCases = std::tuple<Case<Gaussian2, 2>, Case<Gaussian4, 1>, Case<Gaussian6, 2>>;

BOOST_AUTO_TEST_CASE_TEMPLATE(totals_are_conserved_to_round_off, C, TotalCases) {
  constexpr int D = C::dimension;
  const auto cloud = support::disorderly_cloud<D>(24);
  const PSE<typename C::Kernel> pse(1.5 * cloud.spacing);
  check_totals<D>(pse.at(unit_box<D>, cloud.positions(), cloud.volume), cloud);
  check_totals<D>(pse.stored_at(Domain<D>::bounded_box(Box<D>::cube()), cloud.positions(), cloud.volume), cloud);
}
