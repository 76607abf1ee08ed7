// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

#include <cambium/multigrid/eigen.hpp>

namespace bench {

/// Trigonometric interpolation at N (even) points alpha_j = 2 pi j / N.
class Trigonometric {
 public:
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;

  explicit Trigonometric(int n) : n_(n), derivative_(n, n), integral_(n, n), low_(n, n), logarithm_(n) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const double d = step() * (i - j);
        derivative_(i, j) = i == j ? 0.0 : 0.5 * ((i - j) % 2 == 0 ? 1.0 : -1.0) / std::tan(0.5 * d);
        integral_(i, j) = 0.0;
        low_(i, j) = 1.0 / n;
        for (int k = 1; k < n / 2; ++k) integral_(i, j) += 2.0 / n * std::sin(k * d) / k;
        for (int k = 1; k <= shortest(); ++k) low_(i, j) += 2.0 / n * std::cos(k * d);
      }
    }
    for (int j = 0; j < n; ++j) logarithm_[j] = logarithm_weight(j);
  }

  int size() const { return n_; }
  double step() const { return 2.0 * std::numbers::pi / n_; }
  /// d/d alpha of values at the points.
  Vector derivative(const Vector& f) const { return derivative_ * f; }
  /// Of f without its mean: the antiderivative with mean 0.
  Vector integral(const Vector& f) const { return integral_ * f; }
  /// f without waves of number above shortest(): what products of waves would mirror into the others.
  Matrix without_short_waves(const Matrix& f) const { return low_ * f; }
  int shortest() const { return n_ / 3; }
  /// Kress' weights (1991): integral of ln(4 sin^2((alpha_i - beta) / 2)) f(beta) = sum of weight(i - j) f_j.
  double log_weight(int distance) const { return logarithm_[(distance % n_ + n_) % n_]; }
  /// The interpolant anywhere.
  double at(const Vector& f, double alpha) const {
    double sum = 0.0;
    for (int j = 0; j < n_; ++j) {
      const double d = 0.5 * (alpha - step() * j), sine = std::sin(d);
      sum += f[j] * (std::abs(sine) < 1e-14 ? 1.0 : std::sin(n_ * d) * std::cos(d) / (n_ * sine));
    }
    return sum;
  }

 private:
  double logarithm_weight(int j) const {
    double sum = 0.0;
    for (int k = 1; k < n_ / 2; ++k) sum += std::cos(k * step() * j) / k;
    return -4.0 * std::numbers::pi / n_ * (sum + std::cos(std::numbers::pi * j) / n_);
  }

  int n_;
  Matrix derivative_, integral_, low_;
  Vector logarithm_;
};

/// A smooth closed curve by N points, anticlockwise, and what follows from them.
struct ClosedCurve {
  using Vector = Eigen::VectorXd;

  ClosedCurve(const Trigonometric& grid, Vector x_, Vector y_) : x(std::move(x_)), y(std::move(y_)) {
    const Vector dx = grid.derivative(x), dy = grid.derivative(y);
    speed = (dx.array().square() + dy.array().square()).sqrt();
    tx = dx.cwiseQuotient(speed);
    ty = dy.cwiseQuotient(speed);
    const Vector ddx = grid.derivative(dx), ddy = grid.derivative(dy);
    curvature = (dx.cwiseProduct(ddy) - dy.cwiseProduct(ddx)).cwiseQuotient(speed.array().cube().matrix());
    area = 0.5 * grid.step() * (x.dot(dy) - y.dot(dx));
  }
  /// Outward normal.
  const Vector& nx() const { return ty; }
  Vector ny() const { return -tx; }

  Vector x, y;
  Vector speed;  ///< |d position / d alpha|
  Vector tx, ty, curvature;
  double area = 0.0;
};

/// r(theta) (cos theta, sin theta) at points of equal distance along the curve.
template <class Radius>
ClosedCurve equidistant(const Trigonometric& grid, Radius&& radius) {
  const int n = grid.size();
  Eigen::VectorXd theta(n), x(n), y(n);
  for (int j = 0; j < n; ++j) theta[j] = grid.step() * j;
  for (int round = 0; round < 60; ++round) {
    for (int j = 0; j < n; ++j) {
      x[j] = radius(theta[j]) * std::cos(theta[j]);
      y[j] = radius(theta[j]) * std::sin(theta[j]);
    }
    const ClosedCurve curve(grid, x, y);
    // Length from the first point, less what it should be, taken back along the curve.
    const double mean = curve.speed.mean();
    const Eigen::VectorXd excess = grid.integral((curve.speed.array() - mean).matrix());
    for (int j = 0; j < n; ++j) theta[j] -= (excess[j] - excess[0]) / std::hypot(x[j], y[j]);
    if ((excess.array() - excess[0]).abs().maxCoeff() < 1e-12) break;
  }
  return {grid, x, y};
}

/// r(theta) of (11.72) in the plane, e = 0.1.
inline double elliptic(double theta) { return 2.0 / std::hypot(1.1 * std::cos(theta), 0.9 * std::sin(theta)); }

}  // namespace bench
