// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include <cambium/core/error.hpp>
#include <cambium/reaction/kinetics.hpp>
#include <cambium/reaction/polynomial_roots.hpp>

namespace cambium {

/// Derivatives of the rates at c: the kinetics' own, or by centred differences (relative error 1e-10).
template <Kinetics K>
Jacobian<K::species> jacobian(const K& kinetics, const Vec<K::species>& c) {
  if constexpr (requires { kinetics.jacobian(c); }) {
    return kinetics.jacobian(c);
  } else {
    Jacobian<K::species> result;
    for (int j = 0; j < K::species; ++j) {
      const double step = std::cbrt(std::numeric_limits<double>::epsilon()) * std::max(1.0, std::abs(c[j]));
      Vec<K::species> up = c, down = c;
      up[j] += step;
      down[j] -= step;
      const Vec<K::species> difference = (kinetics(up) - kinetics(down)) / (up[j] - down[j]);
      for (int s = 0; s < K::species; ++s) result[s][j] = difference[s];
    }
    return result;
  }
}

namespace detail {

/// Solves a x = b by elimination with pivots; false if a is singular.
template <int N>
bool solve_small(Jacobian<N> a, Vec<N> b, Vec<N>& x) {
  for (int column = 0; column < N; ++column) {
    int pivot = column;
    for (int row = column + 1; row < N; ++row) {
      if (std::abs(a[row][column]) > std::abs(a[pivot][column])) pivot = row;
    }
    if (a[pivot][column] == 0.0 || !std::isfinite(a[pivot][column])) return false;
    std::swap(a[pivot], a[column]);
    std::swap(b[pivot], b[column]);
    for (int row = column + 1; row < N; ++row) {
      const double factor = a[row][column] / a[column][column];
      a[row] -= factor * a[column];
      b[row] -= factor * b[column];
    }
  }
  for (int row = N; row-- > 0;) {
    double sum = b[row];
    for (int column = row + 1; column < N; ++column) sum -= a[row][column] * x[column];
    x[row] = sum / a[row][row];
  }
  return true;
}

}  // namespace detail

/// A uniform state, F(c) = 0, near `guess`: by Newton's method.
/// \throws ValueError if it does not converge or the Jacobian is singular on the way
template <Kinetics K>
Vec<K::species> fixed_point(const K& kinetics, const Vec<K::species>& guess) {
  Vec<K::species> c = guess, step;
  for (int iteration = 0; iteration < 60; ++iteration) {
    if (!detail::solve_small(jacobian(kinetics, c), kinetics(c), step)) break;
    c -= step;
    if (norm(step) <= 1e-14 * std::max(norm(c), 1.0)) return c;
  }
  throw ValueError(detail::message("no uniform state was found from the guess ", guess,
                                   ": Newton's method does not converge; start nearer to one"));
}

/// Growth rates of a small perturbation by a mode on which the Laplacian is -k2: the eigenvalues of J - k2 diag(D),
/// that of largest real part first. On a sphere of radius R degree l has k2 = l (l + 1) / R^2.
/// \param jacobian  of the kinetics at the uniform state that is perturbed
template <int N>
std::array<std::complex<double>, static_cast<std::size_t>(N)> growth_rates(Jacobian<N> jacobian,
                                                                           const Vec<N>& diffusivity, double k2) {
  for (int s = 0; s < N; ++s) jacobian[s][s] -= k2 * diffusivity[s];
  // Characteristic polynomial by Faddeev's and LeVerrier's recursion.
  std::vector<double> coefficient(static_cast<std::size_t>(N) + 1, 1.0);
  Jacobian<N> power;
  for (int m = 1; m <= N; ++m) {
    Jacobian<N> next;
    for (int s = 0; s < N; ++s) {
      for (int j = 0; j < N; ++j) next[s] += jacobian[s][j] * power[j];
      next[s][s] += coefficient[static_cast<std::size_t>(N - m + 1)];
    }
    power = next;
    double trace = 0.0;
    for (int s = 0; s < N; ++s) {
      for (int j = 0; j < N; ++j) trace += jacobian[s][j] * power[j][s];
    }
    coefficient[static_cast<std::size_t>(N - m)] = -trace / m;
  }
  std::array<std::complex<double>, static_cast<std::size_t>(N)> result;
  if constexpr (N == 2) {
    const double half = -0.5 * coefficient[1];
    const std::complex<double> root = std::sqrt(std::complex<double>(half * half - coefficient[0]));
    result = {half + root, half - root};
  } else {
    std::ranges::copy(polynomial_roots(coefficient), result.begin());
  }
  std::ranges::sort(result, [](const auto& a, const auto& b) { return a.real() > b.real(); });
  return result;
}

/// The largest growth rate of a mode on which the Laplacian is -k2: its real part.
template <Kinetics K>
double growth_rate(const K& kinetics, const Vec<K::species>& c, const Vec<K::species>& diffusivity, double k2) {
  return growth_rates(jacobian(kinetics, c), diffusivity, k2)[0].real();
}

/// What grows at a real rate: concentrations v, |v| = 1, v_1 >= 0, with (J - k2 diag(D)) v = rate v.
/// \throws ValueError if the rate is no eigenvalue, to 1e-6 of the matrix
template <int N>
Vec<N> growing_direction(Jacobian<N> jacobian, const Vec<N>& diffusivity, double k2, double rate) {
  double size = 0.0;
  for (int s = 0; s < N; ++s) {
    jacobian[s][s] -= k2 * diffusivity[s];
    for (int j = 0; j < N; ++j) size = std::max(size, std::abs(jacobian[s][j]));
  }
  Jacobian<N> shifted = jacobian;
  for (int s = 0; s < N; ++s) shifted[s][s] -= rate + 1e-10 * size;
  Vec<N> v = Vec<N>::constant(1.0), next;
  for (int iteration = 0; iteration < 4; ++iteration) {
    if (!detail::solve_small(shifted, v, next)) break;
    v = next / norm(next);
  }
  if (v[0] < 0.0) v = -v;
  Vec<N> off;
  for (int s = 0; s < N; ++s) off[s] = dot(jacobian[s], v) - rate * v[s];
  if (!(norm(off) <= 1e-6 * size)) {
    throw ValueError(detail::message("nothing grows at the rate ", rate, " where the Laplacian is ", -k2,
                                     ": take a real one of growth_rates()"));
  }
  return v;
}

}  // namespace cambium
