// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include <cambium/core/vec.hpp>

namespace cambium {

/// Exponents of a monomial x^a = prod_d x_d^a_d, or the orders of a partial derivative.
template <int D>
using MultiIndex = Vec<D, int>;

template <int D>
constexpr int total(const MultiIndex<D>& a) {
  int sum = 0;
  for (int d = 0; d < D; ++d) sum += a[d];
  return sum;
}

/// a! = prod_d a_d!
template <int D>
constexpr double factorial(const MultiIndex<D>& a) {
  double result = 1.0;
  for (int d = 0; d < D; ++d) {
    for (int m = 2; m <= a[d]; ++m) result *= m;
  }
  return result;
}

/// Number of monomials in D variables of the degrees 1, ..., degree: C(degree + D, D) - 1.
template <int D>
constexpr int monomial_count(int degree) {
  int result = 1;
  for (int d = 1; d <= D; ++d) result = result * (degree + d) / d;
  return result - 1;
}

/// All monomials in D variables of the degrees 1, ..., Degree, lower degrees first.
template <int D, int Degree>
constexpr auto monomials() {
  std::array<MultiIndex<D>, static_cast<std::size_t>(monomial_count<D>(Degree))> result{};
  std::size_t count = 0;
  int codes = 1;
  for (int d = 0; d < D; ++d) codes *= Degree + 1;
  for (int degree = 1; degree <= Degree; ++degree) {
    for (int code = 0; code < codes; ++code) {
      MultiIndex<D> a;
      for (int d = 0, rest = code; d < D; ++d, rest /= Degree + 1) a[d] = rest % (Degree + 1);
      if (total(a) == degree) result[count++] = a;
    }
  }
  return result;
}

}  // namespace cambium
