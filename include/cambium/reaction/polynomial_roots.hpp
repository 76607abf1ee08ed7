// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include <cambium/core/error.hpp>

namespace cambium {

/// All roots of a polynomial, the coefficient of x^i in coefficient[i], the last one not zero: by Durand's and Kerner's
/// simultaneous iteration. Simple roots to round-off, m-fold ones to its m-th root.
/// \throws ValueError if a coefficient is not finite, the last one is zero, or the iteration does not converge
inline std::vector<std::complex<double>> polynomial_roots(const std::vector<double>& coefficient) {
  using Complex = std::complex<double>;
  if (coefficient.empty() || coefficient.back() == 0.0 ||
      !std::ranges::all_of(coefficient, [](double c) { return std::isfinite(c); })) {
    throw ValueError("the coefficients of a polynomial must be finite and the last one not zero");
  }
  const std::size_t degree = coefficient.size() - 1;
  // Roots lie within this of the origin (Fujiwara 1916); without a scale all are zero.
  double radius = 0.0;
  for (std::size_t i = 0; i < degree; ++i) {
    const double ratio = std::abs(coefficient[i] / coefficient[degree]);
    radius = std::max(radius, 2.0 * std::pow(ratio, 1.0 / static_cast<double>(degree - i)));
  }
  std::vector<Complex> root(degree);
  if (radius == 0.0) return root;
  for (std::size_t i = 0; i < degree; ++i) {
    root[i] = std::polar(0.5 * radius, 0.4 + 6.283185307179586 * static_cast<double>(i) / static_cast<double>(degree));
  }
  for (int iteration = 0; iteration < 500; ++iteration) {
    double change = 0.0;
    for (std::size_t i = 0; i < degree; ++i) {
      Complex value = coefficient[degree], product = coefficient[degree];
      for (std::size_t k = degree; k-- > 0;) value = value * root[i] + coefficient[k];
      for (std::size_t j = 0; j < degree; ++j) {
        if (j != i) product *= root[i] - root[j];
      }
      const Complex step = product == 0.0 ? Complex(1e-8 * radius) : value / product;
      root[i] -= step;
      change = std::max(change, std::abs(step));
    }
    if (change <= 1e-15 * radius) return root;
    // Multiple roots are approached linearly and end in round-off.
    if (iteration > 200 && change <= 1e-6 * radius) return root;
  }
  throw ValueError("the roots of a polynomial were not found in 500 iterations: its coefficients are badly scaled");
}

/// The real roots in ascending order: those whose imaginary part is round-off.
inline std::vector<double> real_roots(const std::vector<double>& coefficient) {
  std::vector<double> result;
  for (const auto& root : polynomial_roots(coefficient)) {
    if (std::abs(root.imag()) <= 1e-9 * std::abs(root)) result.push_back(root.real());
  }
  std::ranges::sort(result);
  return result;
}

}  // namespace cambium
