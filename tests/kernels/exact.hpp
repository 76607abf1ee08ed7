// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include <cambium/kernels/hat.hpp>
#include <cambium/kernels/lambda.hpp>
#include <cambium/kernels/m3.hpp>
#include <cambium/kernels/m4.hpp>
#include <cambium/kernels/m4_prime.hpp>
#include <cambium/kernels/m6.hpp>
#include <cambium/kernels/m6_triple_prime.hpp>
#include <cambium/kernels/remeshing_kernel.hpp>

namespace exact {

/// Fractions of integers of any length (boost::multiprecision::cpp_rational without expression templates).
using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;

/// Every piecewise polynomial kernel of the library.
using Kernels = std::tuple<cambium::Hat, cambium::M3, cambium::M4, cambium::M4Prime, cambium::M6,
                           cambium::M6TriplePrime, cambium::Lambda21, cambium::Lambda22, cambium::Lambda42,
                           cambium::Lambda44, cambium::Lambda64, cambium::Lambda84>;

inline Rational power(const Rational& x, int n) {
  Rational result = 1;
  for (int i = 0; i < n; ++i) result *= x;
  return result;
}

/// The coefficients of a kernel as fractions; no template, so that exact arithmetic is compiled once.
struct Kernel {
  int support;
  std::vector<std::vector<Rational>> piece;  // piece[i][j]: coefficient of |x|^j

  int pieces() const { return static_cast<int>(piece.size()); }
  int degree() const { return static_cast<int>(piece[0].size()) - 1; }
  /// Upper end of piece i.
  Rational break_point(int i) const { return support % 2 == 0 ? Rational(i + 1) : Rational(2 * i + 1, 2); }

  /// `order`-th derivative of piece i at x >= 0.
  Rational derivative(int i, int order, const Rational& x) const {
    Rational sum = 0;
    for (int j = degree(); j >= order; --j) {
      Rational term = piece[i][j];
      for (int m = 0; m < order; ++m) term *= j - m;
      sum = sum * x + term;
    }
    return sum;
  }
  Rational value(Rational x) const {
    if (x < 0) x = -x;
    for (int i = 0; i < pieces(); ++i) {
      if (x <= break_point(i)) return derivative(i, 0, x);
    }
    return 0;
  }
  /// sum_j (j - t)^a W(t - j) over all nodes that could be under the kernel, none left out by a rule for the first
  /// node.
  Rational moment(int a, const Rational& t) const {
    Rational sum = 0;
    for (int j = -support; j <= support + 1; ++j) sum += power(j - t, a) * value(t - j);
    return sum;
  }
};

/// denominator, numerators of one piece after the other
inline Kernel make_kernel(int support, int degree, const std::vector<long long>& coefficients) {
  Kernel result{support, {}};
  for (std::size_t at = 0; at < coefficients.size(); at += degree + 2) {
    result.piece.emplace_back();
    for (int j = 0; j <= degree; ++j) result.piece.back().emplace_back(coefficients[at + 1 + j], coefficients[at]);
  }
  return result;
}

template <class K>
Kernel kernel() {
  std::vector<long long> coefficients;
  for (const auto& piece : K::pieces.piece) {
    coefficients.push_back(piece.denominator);
    coefficients.insert(coefficients.end(), piece.numerator.begin(), piece.numerator.end());
  }
  return make_kernel(K::support, K::pieces.degree, coefficients);
}

/// A kernel with what it states of itself.
struct Statement {
  std::string name;
  Kernel w;
  int moments;
  int continuity;
  bool interpolating;
  bool non_negative;
};

template <class K>
Statement statement(const char* name) {
  return {name, kernel<K>(), K::moments, K::continuity, K::interpolating, cambium::is_non_negative<K>};
}

/// Every piecewise polynomial kernel of the library. A table rather than a type list: what is proven of it in exact
/// arithmetic is then compiled once.
inline const std::vector<Statement>& statements() {
  using namespace cambium;
  static const std::vector<Statement> all{
      statement<Hat>("Hat"),
      statement<M3>("M3"),
      statement<M4>("M4"),
      statement<M4Prime>("M4Prime"),
      statement<M6>("M6"),
      statement<M6TriplePrime>("M6TriplePrime"),
      statement<Lambda21>("Lambda21"),
      statement<Lambda22>("Lambda22"),
      statement<Lambda42>("Lambda42"),
      statement<Lambda44>("Lambda44"),
      statement<Lambda64>("Lambda64"),
      statement<Lambda84>("Lambda84"),
  };
  return all;
}

}  // namespace exact
