// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include <cambium/parallel/compensated_sum.hpp>
#include <cambium/particles/validation.hpp>

namespace cambium {
namespace detail {

template <class V>
struct Sum {
  using Type = double;
};
template <int C, class T>
struct Sum<Columns<C, T>> {
  using Type = Vec<C>;
};
/// double for an array of scalars, Vec<C> for Columns<C, T>
template <class V>
using SumOf = typename Sum<V>::Type;

/// sum_p f(p) strength_p, compensated. \throws ValueError if the sum is not finite
template <class V, class F, Execution E>
SumOf<V> weighted_total(const V& strengths, F&& f, const E& execution) {
  const auto q = read_columns(strengths);
  SumOf<V> result{};
  bool finite = true;
  for (int c = 0; c < q.count; ++c) {
    const auto column = q.column(c);
    const auto term = [&](std::size_t p) { return static_cast<double>(column[p]) * f(p); };
    const auto sum = reduce(execution, q.size(), CompensatedSum{}, term, [](auto a, const auto& b) { return a += b; });
    component(result, c) = sum.value();
    finite = finite && std::isfinite(sum.value());
  }
  if (!finite) {
    require_finite(q, "strength", execution);
    throw ValueError(detail::message("sum over particles is ", result, ": it overflows; choose larger units"));
  }
  return result;
}

}  // namespace detail

/// Total of point particles, sum_p Q_p: a double for an array of scalars, a Vec<C> for Columns<C, T>.
///
/// Compensated summation in double precision in a fixed order: correct to the last digit but one unless terms cancel to
/// less than 1e-16 of their size, and the same bits for any number of threads.
/// \throws ValueError naming the first particle whose strength is not finite
template <class V, Execution E = OpenMP>
auto total(const V& strengths, const E& execution = {}) {
  return detail::weighted_total(
      strengths, [](std::size_t) { return 1.0; }, execution);
}

/// Moment of point particles, sum_p Q_p (x_p - about)^alpha, x^alpha = x_0^alpha_0 x_1^alpha_1 ...; accuracy and type
/// as total(). Positions are taken as they are: no wrapping along periodic axes. \throws ValueError if an exponent is
/// negative, or a strength or position is not finite; SizeError if there are not as
///         many strengths as positions
template <int D, class P, class V, Execution E = OpenMP>
auto moment(const Columns<D, P>& positions, const V& strengths, const Index<D>& alpha, const Vec<D>& about = {},
            const E& execution = {}) {
  require_size(read_columns(strengths).size(), positions.size(), "array of strengths");
  for (int d = 0; d < D; ++d) {
    if (alpha[d] < 0) throw ValueError(detail::message("exponents ", alpha, " of a moment: they must not be negative"));
  }
  require_finite(read_columns(positions), "position", execution);
  const auto power = [&](std::size_t p) {
    double result = 1.0;
    for (int d = 0; d < D; ++d) {
      const double x = static_cast<double>(positions.column(d)[p]) - about[d];
      for (std::ptrdiff_t i = 0; i < alpha[d]; ++i) result *= x;
    }
    return result;
  };
  return detail::weighted_total(strengths, power, execution);
}

/// All exponents alpha with |alpha| <= degree, by total degree, then axis 0 first: 1; x, y; x^2, xy, y^2; ...
template <int D>
std::vector<Index<D>> exponents_up_to(int degree) {
  std::vector<Index<D>> result;
  for (int total = 0; total <= degree; ++total) {
    Index<D> alpha;
    alpha[0] = total;
    for (;;) {
      result.push_back(alpha);
      // The next in order: one unit goes from the last axis before D - 1 that has any to the axis after it, together
      // with all that is on axis D - 1.
      int d = D - 2;
      while (d >= 0 && alpha[d] == 0) --d;
      if (d < 0) break;
      const std::ptrdiff_t last = std::exchange(alpha[D - 1], 0);
      --alpha[d];
      alpha[d + 1] = last + 1;
    }
  }
  return result;
}

/// All moments up to a degree, in the order of exponents_up_to<D>(degree); see moment().
/// \throws as moment()
template <int D, class P, class V, Execution E = OpenMP>
auto moments_up_to(int degree, const Columns<D, P>& positions, const V& strengths, const Vec<D>& about = {},
                   const E& execution = {}) {
  std::vector<detail::SumOf<V>> result;
  for (const Index<D>& alpha : exponents_up_to<D>(degree)) {
    result.push_back(moment(positions, strengths, alpha, about, execution));
  }
  return result;
}

}  // namespace cambium
