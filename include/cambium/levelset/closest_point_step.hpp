// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include <cambium/levelset/jet.hpp>

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

/// Step to the tangent plane of the level function's zero set and along it (Chopp 2001, eq. 3.2).
///
/// \param jet   at y
/// \param back  x - y
template <class T, int D>
Vec<D, T> tangent_step(const Jet<T, D>& jet, const Vec<D, T>& back) {
  const T slope = dot(jet.gradient, jet.gradient);
  return back - (dot(back, jet.gradient) + jet.value) / slope * jet.gradient;
}

/// One step towards the closest point of x on a zero set: Newton's method for y - x + mu grad p = 0, p = 0, whose
/// unknowns are y and mu; where the matrix is singular (a focal point) a tangent step instead.
///
/// \param jet   at y, its gradient not zero
/// \param back  x - y
template <class T, int D>
Vec<D, T> closest_point_step(const Jet<T, D>& jet, const Vec<D, T>& back, T& mu) {
  const Vec<D, T>& g = jet.gradient;
  const T slope = dot(g, g);
  std::array<Vec<D, T>, D> matrix = jet.hessian;
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
      const T change = (dot(g, of_residual) + jet.value) / through;
      mu += change;
      return of_residual - change * of_gradient;
    }
  }
  const Vec<D, T> step = tangent_step(jet, back);
  mu = dot(back - step, g) / slope;
  return step;
}

}  // namespace cambium::detail
