// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE jet
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <tuple>
#include <vector>

#include <cambium/kernels.hpp>
#include <cambium/levelset/jet.hpp>

#include "support/order.hpp"

using namespace cambium;

namespace {

template <class K, int D>
struct Case {
  using Kernel = K;
  static constexpr int dimension = D;
};
using Cases =
    std::tuple<Case<M4Prime, 2>, Case<M6, 2>, Case<Lambda<4, 4>, 2>, Case<Lambda<6, 4>, 2>, Case<Lambda<8, 4>, 2>,
               Case<M4Prime, 3>, Case<M6, 3>, Case<Lambda<4, 4>, 3>, Case<Lambda<6, 4>, 3>>;

template <int D>
struct Wave {
  double k[3] = {1.3, 0.9, -1.1};

  double phase(const Vec<D>& x) const {
    double sum = 0.2;
    for (int d = 0; d < D; ++d) sum += k[d] * x[d];
    return sum;
  }
  double value(const Vec<D>& x) const { return std::sin(phase(x)); }
  double first(const Vec<D>& x, int d) const { return k[d] * std::cos(phase(x)); }
  double second(const Vec<D>& x, int d, int e) const { return -k[d] * k[e] * std::sin(phase(x)); }
};

/// Largest errors of value, gradient and Hessian over points in the middle of 16 nodes of spacing h along each axis.
template <class K, int D, class T>
Vec<3> errors(double h) {
  constexpr std::ptrdiff_t n = 16;
  const Wave<D> wave;
  Index<D> stride;
  stride[0] = 1;
  for (int d = 1; d < D; ++d) stride[d] = stride[d - 1] * n;
  std::vector<T> values(static_cast<std::size_t>(stride[D - 1] * n + 16));
  const auto at = [&](const Vec<D>& u) { return h * u; };
  for (std::ptrdiff_t i = 0; i < stride[D - 1] * n; ++i) {
    Vec<D> u;
    for (int d = 0; d < D; ++d) u[d] = static_cast<double>(i / stride[d] % n);
    values[static_cast<std::size_t>(i)] = static_cast<T>(wave.value(at(u)));
  }
  Vec<3> worst{};
  for (int sample = 0; sample < 200; ++sample) {
    Vec<D, T> u;
    Vec<D> x;
    for (int d = 0; d < D; ++d) {
      u[d] = static_cast<T>(6.0 + std::fmod(0.754877 * (sample + 1) * (d + 1) + 0.13 * d, 3.0));
      x[d] = h * static_cast<double>(u[d]);
    }
    const Jet<T, D> jet = Interpolant<K, T, D>::jet(values.data(), stride, u);
    BOOST_TEST(jet.value == (Interpolant<K, T, D>::value(values.data(), stride, u)),
               boost::test_tools::tolerance(T(1e-4)));
    worst[0] = std::max(worst[0], std::abs(jet.value - wave.value(x)));
    for (int d = 0; d < D; ++d) {
      worst[1] = std::max(worst[1], std::abs(jet.gradient[d] / h - wave.first(x, d)));
      for (int e = 0; e < D; ++e) {
        worst[2] = std::max(worst[2], std::abs(jet.hessian[d][e] / (h * h) - wave.second(x, d, e)));
      }
    }
  }
  return worst;
}

}  // namespace

// A kernel that keeps moments up to p interpolates derivative m at order p + 1 - m, if it has so many derivatives.
BOOST_AUTO_TEST_CASE_TEMPLATE(derivatives_have_their_order, C, Cases) {
  using K = typename C::Kernel;
  const Vec<3> coarse = errors<K, C::dimension, double>(0.2);
  const Vec<3> fine = errors<K, C::dimension, double>(0.1);
  for (int m = 0; m < 3 && m <= K::continuity; ++m) {
    const int order = K::moments + 1 - m;
    BOOST_TEST(support::observed_order(coarse[m], fine[m]) > order - 0.3);
  }
}

// Single precision: 2^-24 of values up to 1, times 1/h^m and the sum of |W^(m)|, which is below 10 for Lambda_{4,4}.
BOOST_AUTO_TEST_CASE(single_precision) {
  const Vec<3> error = errors<Lambda<4, 4>, 3, float>(0.1);
  const Vec<3> exact = errors<Lambda<4, 4>, 3, double>(0.1);
  for (int m = 0; m < 3; ++m) BOOST_TEST(error[m] < exact[m] + 60e-8 * std::pow(10.0, m) * (1 + 9 * m));
}
