// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <cambium/levelset/jet.hpp>
#include <cambium/levelset/patch.hpp>

namespace cambium::detail {

/// Inverse of a symmetric matrix, by cofactors.
template <class T, int D>
class SymmetricInverse {
 public:
  explicit SymmetricInverse(const std::array<Vec<D, T>, D>& matrix) {
    if constexpr (D == 2) {
      cofactor_ = {Vec<2, T>{matrix[1][1], -matrix[0][1]}, Vec<2, T>{-matrix[0][1], matrix[0][0]}};
    } else {
      cofactor_[0] = {matrix[1][1] * matrix[2][2] - matrix[1][2] * matrix[1][2],
                      matrix[0][2] * matrix[1][2] - matrix[0][1] * matrix[2][2],
                      matrix[0][1] * matrix[1][2] - matrix[0][2] * matrix[1][1]};
      cofactor_[1] = {cofactor_[0][1], matrix[0][0] * matrix[2][2] - matrix[0][2] * matrix[0][2],
                      matrix[0][1] * matrix[0][2] - matrix[0][0] * matrix[1][2]};
      cofactor_[2] = {cofactor_[0][2], cofactor_[1][2], matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[0][1]};
    }
    const T determinant = dot(matrix[0], cofactor_[0]);
    exists_ = std::abs(determinant) > T(64) * std::numeric_limits<T>::epsilon();
    scale_ = T(1) / determinant;
  }
  /// False if the matrix is singular to rounding.
  bool exists() const { return exists_; }
  Vec<D, T> operator()(const Vec<D, T>& b) const {
    Vec<D, T> result;
    for (int i = 0; i < D; ++i) result[i] = scale_ * dot(cofactor_[i], b);
    return result;
  }

 private:
  std::array<Vec<D, T>, D> cofactor_;
  T scale_;
  bool exists_;
};

/// The closest point on the zero set of the function that kernel K interpolates from a patch.
///
/// Newton's method for y - x + mu grad p = 0, p = 0, whose unknowns are y and mu; where the matrix is singular (a focal
/// point) a step of Chopp's instead: to the tangent plane and along it (Chopp 2001, eq. 3.2). Lengths in spacings.
template <class K, class T, int D>
class ClosestPointSearch {
 public:
  /// \param reach  how far from x the search may go
  ClosestPointSearch(const Patch<T, D>& patch, T reach) : patch_(patch), reach_(reach) {}

  /// \param x      point in spacings from entry 0 of the patch
  /// \param y      first guess; the closest point if it is found, else unchanged
  /// \param known  the jet at the first guess, or null
  bool operator()(const Vec<D, T>& x, Vec<D, T>& y, const Jet<T, D>* known = nullptr) {
    Vec<D, T> at = y;
    T mu{};
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      if (known && iteration == 0) {
        jet_ = *known;
      } else if (Interpolant<K, T, D>::inside(patch_.edge(), at)) {
        jet_ = Interpolant<K, T, D>::jet(patch_.data(), patch_.stride(), at);
      } else {
        return false;
      }
      const T slope = dot(jet_.gradient, jet_.gradient);
      if (!(slope > T(0))) return false;
      if (iteration == 0) mu = dot(x - at, jet_.gradient) / slope;
      Vec<D, T> step = newton_step(x - at, slope, mu);
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

  Vec<D, T> newton_step(const Vec<D, T>& back, T slope, T& mu) const {
    const Vec<D, T>& g = jet_.gradient;
    std::array<Vec<D, T>, D> matrix = jet_.hessian;
    for (int d = 0; d < D; ++d) {
      matrix[d] *= mu;
      matrix[d][d] += T(1);
    }
    const SymmetricInverse<T, D> inverse(matrix);
    if (inverse.exists()) {
      const Vec<D, T> of_gradient = inverse(g);
      const T through = dot(g, of_gradient);
      if (std::abs(through) > T(0.05) * slope) {
        const Vec<D, T> of_residual = inverse(back - mu * g);
        const T change = (dot(g, of_residual) + jet_.value) / through;
        mu += change;
        return of_residual - change * of_gradient;
      }
    }
    const Vec<D, T> step = back - (dot(back, g) + jet_.value) / slope * g;
    mu = dot(back - step, g) / slope;
    return step;
  }

  const Patch<T, D>& patch_;
  T reach_;
  Jet<T, D> jet_;
};

}  // namespace cambium::detail
