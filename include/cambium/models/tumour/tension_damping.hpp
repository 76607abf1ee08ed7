// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <cambium/core/error.hpp>
#include <cambium/multigrid/eigen.hpp>
#include <cambium/parallel/execution.hpp>

namespace cambium::detail {

/// x = f(A) b for an operator A with a spectrum right of 0, of which products are all that is known, by Arnoldi's basis
/// of the Krylov space, in which f is that of a small matrix:
///   damp():    f = 1 / (share + weight A^(3/2) (1 + short_waves A)),
///   smooth():  f = 1 / (1 + smoothing A^2).
/// Keeps its vectors.
class TensionDamping {
 public:
  using Vector = std::vector<double>;

  /// What one more piece of the basis must change of x, relative to x, for it to end.
  static constexpr double tolerance = 1e-3;
  static constexpr int most_products = 80;
  /// With A = -h^2 Lap_Gamma, whose largest eigenvalue is 4 along an axis: steps with no pressure outside are stable
  /// without, those of free space from 0.2 on, where what the lattice makes of the shortest waves decays faster than
  /// k^3 / 2 of them says. Long waves do not notice.
  static constexpr double short_waves = 0.5;

  /// Waves of two pi spacings are halved.
  static constexpr double smoothing = 1.0;

  /// \param apply  apply(in, out): out := A in. \param x  b on entry. \return products
  /// \throws ValueError if b is not finite
  template <class Apply>
  int damp(double share, double weight, Apply&& apply, Vector& x, const OpenMP& execution) {
    return find([&](const Matrix& a,
                    const Matrix& one) { return Matrix(share * one + weight * a * root(a) * (one + short_waves * a)); },
                apply, x, execution);
  }
  /// Arguments as of damp().
  template <class Apply>
  int smooth(Apply&& apply, Vector& x, const OpenMP& execution) {
    return find([](const Matrix& a, const Matrix& one) { return Matrix(one + smoothing * a * a); }, apply, x,
                execution);
  }

 private:
  using Matrix = Eigen::MatrixXd;

  /// Vectors of the basis between two looks at x.
  static constexpr int piece = 4;
  /// Added to A, whose smallest eigenvalue is zero or a little less: its square root is found by inverses.
  static constexpr double shift = 1e-4;

  /// \param inverse  1 / f of a matrix
  template <class Inverse, class Apply>
  int find(Inverse&& inverse, Apply&& apply, Vector& x, const OpenMP& execution) {
    const double start = std::sqrt(dot(x, x, execution));
    if (start == 0.0) return 0;
    if (!std::isfinite(start)) {
      throw ValueError("the speed of the interface is not finite: the pressure has blown up; take shorter steps");
    }
    hessenberg_.setZero(most_products + 1, most_products);
    basis_.resize(static_cast<std::size_t>(most_products) + 1);
    basis_[0].resize(x.size());
    for_each(execution, x.size(), [&](std::size_t i) { basis_[0][i] = x[i] / start; });
    Eigen::VectorXd last = Eigen::VectorXd::Zero(0), now;
    int size = 0;
    for (bool done = false; !done;) {
      for (int k = 0; k < piece && !done; ++k) done = !extend(apply, size++, execution);
      const Matrix one = Matrix::Identity(size, size);
      now = inverse(hessenberg_.topLeftCorner(size, size) + shift * one, one).partialPivLu().solve(one.col(0));
      Eigen::VectorXd change = now;
      change.head(last.size()) -= last;
      done = done || size >= most_products || (last.size() > 0 && change.norm() <= tolerance * now.norm());
      last = now;
    }
    combine(start * now, x, execution);
    return size;
  }
  static double dot(const Vector& a, const Vector& b, const OpenMP& execution) {
    return reduce(
        execution, a.size(), 0.0, [&](std::size_t i) { return a[i] * b[i]; }, [](double s, double t) { return s + t; });
  }
  /// One more vector of the basis, by Gram and Schmidt's method as modified. \return false if there is none
  template <class Apply>
  bool extend(Apply&& apply, int k, const OpenMP& execution) {
    Vector& next = basis_[static_cast<std::size_t>(k) + 1];
    next.resize(basis_[0].size());
    apply(basis_[static_cast<std::size_t>(k)], next);
    for (int j = 0; j <= k; ++j) {
      const Vector& before = basis_[static_cast<std::size_t>(j)];
      const double part = dot(next, before, execution);
      hessenberg_(j, k) = part;
      for_each(execution, next.size(), [&](std::size_t i) { next[i] -= part * before[i]; });
    }
    const double length = std::sqrt(dot(next, next, execution));
    hessenberg_(k + 1, k) = length;
    if (length <= 1e-12 * hessenberg_.norm()) return false;
    for_each(execution, next.size(), [&](std::size_t i) { next[i] /= length; });
    return true;
  }
  /// Square root, by the iteration of Denman and Beavers (1976), which converges quadratically.
  static Matrix root(const Matrix& matrix) {
    Matrix x = matrix, y = Matrix::Identity(matrix.rows(), matrix.cols());
    for (int k = 0; k < 40; ++k) {
      const Matrix next = 0.5 * (x + y.partialPivLu().inverse());
      y = 0.5 * (y + x.partialPivLu().inverse());
      const double change = (next - x).norm();
      x = next;
      if (change <= 1e-10 * x.norm()) break;
    }
    return x;
  }
  void combine(const Eigen::VectorXd& weights, Vector& x, const OpenMP& execution) const {
    for_each(execution, x.size(), [&](std::size_t i) {
      double sum = 0.0;
      for (Eigen::Index k = 0; k < weights.size(); ++k) sum += weights[k] * basis_[static_cast<std::size_t>(k)][i];
      x[i] = sum;
    });
  }

  std::vector<Vector> basis_;
  Matrix hessenberg_;
};

}  // namespace cambium::detail
