// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <cambium/levelset/jet.hpp>
#include <cambium/levelset/patch.hpp>

namespace cambium::detail {

/// a := A^-1 b for a symmetric matrix, by cofactors. \return false if A is singular to rounding
template <class T, int D>
bool solve_symmetric(const std::array<Vec<D, T>, D>& A, const Vec<D, T>& b, Vec<D, T>& a) {
  std::array<Vec<D, T>, D> cofactor;
  if constexpr (D == 2) {
    cofactor = {Vec<2, T>{A[1][1], -A[0][1]}, Vec<2, T>{-A[0][1], A[0][0]}};
  } else {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const int r = (i + 1) % 3, s = (i + 2) % 3, u = (j + 1) % 3, v = (j + 2) % 3;
        cofactor[i][j] = A[r][u] * A[s][v] - A[r][v] * A[s][u];
      }
    }
  }
  const T determinant = dot(A[0], cofactor[0]);
  if (!(std::abs(determinant) > T(64) * std::numeric_limits<T>::epsilon())) return false;
  for (int i = 0; i < D; ++i) a[i] = dot(cofactor[i], b) / determinant;
  return true;
}

/// The closest point on the zero set of the function that kernel K interpolates from a patch.
///
/// Newton's method for y - x + mu grad p = 0, p = 0, whose unknowns are y and mu; where the matrix is singular (a focal
/// point) a step of Chopp's instead: to the tangent plane and along it (Chopp 2001, eq. 3.2). Lengths in spacings.
template <class K, class T, int D>
class ClosestPointSearch {
 public:
  /// \param reach  how far from x the search may go
  ClosestPointSearch(const Patch<T, D>& patch, T reach) : patch_(patch), reach_(reach) {}

  /// \param x  point in spacings from entry 0 of the patch
  /// \param y  first guess; the closest point if it is found, else unchanged
  bool operator()(const Vec<D, T>& x, Vec<D, T>& y) {
    Vec<D, T> at = y;
    T mu{};
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      jet_ = Interpolant<K, T, D>::jet(patch_.data(), patch_.stride(), at);
      const T slope = dot(jet_.gradient, jet_.gradient);
      if (!(slope > T(0))) return false;
      if (iteration == 0) mu = dot(x - at, jet_.gradient) / slope;
      Vec<D, T> step;
      if (!newton_step(x - at, slope, mu, step)) return false;
      const T length = norm(step);
      if (length > longest_step) step *= longest_step / length;
      at += step;
      if (!(norm(at - x) < reach_)) return false;
      if (length < tolerance) {
        y = at;
        return true;
      }
    }
    return false;
  }
  /// Jet at the last point but one of the search, within `tolerance` of the closest point.
  const Jet<T, D>& jet() const { return jet_; }

 private:
  static constexpr int most_iterations = 16;
  static constexpr T longest_step = T(0.5);
  /// The error of the point is the square of the last step, relative to the radius of curvature.
  static constexpr T tolerance = sizeof(T) == 8 ? T(1e-7) : T(1e-4);

  bool newton_step(const Vec<D, T>& back, T slope, T& mu, Vec<D, T>& step) const {
    const Vec<D, T>& g = jet_.gradient;
    std::array<Vec<D, T>, D> A = jet_.hessian;
    for (int d = 0; d < D; ++d) {
      A[d] *= mu;
      A[d][d] += T(1);
    }
    Vec<D, T> of_residual, of_gradient;
    if (solve_symmetric<T, D>(A, back - mu * g, of_residual) && solve_symmetric<T, D>(A, g, of_gradient)) {
      const T through = dot(g, of_gradient);
      if (std::abs(through) > T(0.05) * slope) {
        const T change = (dot(g, of_residual) + jet_.value) / through;
        step = of_residual - change * of_gradient;
        mu += change;
        return true;
      }
    }
    step = back - (dot(back, g) + jet_.value) / slope * g;
    mu = dot(back - step, g) / slope;
    return true;
  }

  const Patch<T, D>& patch_;
  T reach_;
  Jet<T, D> jet_;
};

}  // namespace cambium::detail
