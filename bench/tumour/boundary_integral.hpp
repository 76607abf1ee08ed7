// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include <cambium/multigrid/eigen.hpp>

#include "tumour/closed_curve.hpp"

namespace bench {

/// Numbers of the model, as in TumourParameters.
struct PlaneTumour {
  double apoptosis = 0.5;
  double growth = 20.0;
  double tension = 1.0;
  bool free_space = true;  ///< else p = 0 outside
};

/// Tumours in the plane without a necrotic core, by integrals along the interface alone: no lattice, of spectral
/// accuracy in the number of points.
///
/// c = S_1 sigma, the potential of a single layer of Lap c = c (K_0(r) / 2 pi). With p = -G c + G A |x|^2 / 4 + w, w is
/// harmonic inside; with f = gamma kappa + G - G A |x|^2 / 4,
///   p = 0 outside:  w = f on the interface, a double layer D mu;           dw/dn = d/ds S_0 dmu/ds
///   free space:     w - p_out = f, dw/dn - dp_out/dn = g, so that w and p_out are S_0 g - D f;
///                   g = G dc/dn - G A x . n / 2
/// Logarithms of kernels by Kress' quadrature. Points move with V n and along the interface such that they keep equal
/// distances (Hou, Lowengrub & Shelley 1994), without the shortest third of the waves.
class BoundaryIntegral {
 public:
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;

  BoundaryIntegral(int points, const PlaneTumour& numbers) : grid_(points), numbers_(numbers) {}

  const Trigonometric& grid() const { return grid_; }
  /// V at the points.
  Vector speed(const ClosedCurve& curve) const {
    const double share = numbers_.growth * numbers_.apoptosis;
    const Vector square = curve.x.cwiseAbs2() + curve.y.cwiseAbs2();
    const Vector across = curve.x.cwiseProduct(curve.nx()) + curve.y.cwiseProduct(curve.ny());
    const Vector f =
        (numbers_.tension * curve.curvature.array() + numbers_.growth - 0.25 * share * square.array()).matrix();
    const Vector g = numbers_.growth * nutrient_slope(curve) - 0.5 * share * across;
    const Matrix single = single_layer(curve), normal = harmonic_normal(curve);
    if (numbers_.free_space) {
      const Vector weighed = g.cwiseProduct(curve.speed);
      return 0.5 * g - normal * weighed + slope_of_double_layer(curve, single, f);
    }
    // The double layer's kernel is the transpose of the single layer's normal derivative.
    const Matrix system =
        normal.transpose() * curve.speed.asDiagonal() - 0.5 * Matrix::Identity(grid_.size(), grid_.size());
    const Vector mu = system.partialPivLu().solve(f);
    return g - slope_of_double_layer(curve, single, mu);
  }
  /// The curve at a later time, by `steps` steps of Runge and Kutta's classical rule.
  ClosedCurve run(ClosedCurve curve, double duration, int steps) const {
    const double dt = duration / steps;
    for (int i = 0; i < steps; ++i) {
      const Matrix a = rate(curve), b = rate(moved(curve, a, 0.5 * dt)), c = rate(moved(curve, b, 0.5 * dt)),
                   d = rate(moved(curve, c, dt));
      curve = moved(curve, (a + 2.0 * b + 2.0 * c + d) / 6.0, dt);
    }
    return curve;
  }
  /// Steps with which run() is stable: the shortest wave decays at gamma k^3 (half of it in free space).
  int stable_steps(const ClosedCurve& curve, double duration) const {
    const double k = grid_.shortest() / curve.speed.minCoeff();
    const double decay = numbers_.tension * k * k * k * (numbers_.free_space ? 0.5 : 1.0);
    return std::max(64, static_cast<int>(std::ceil(duration * decay / 2.0)));
  }

 private:
  static constexpr double two_pi = 2.0 * std::numbers::pi;

  /// Velocity of the points, a row for each.
  Matrix rate(const ClosedCurve& curve) const {
    const Vector v = speed(curve);
    const Vector along = -grid_.integral(curve.speed.cwiseProduct(curve.curvature).cwiseProduct(v));
    Matrix velocity(grid_.size(), 2);
    velocity.col(0) = v.cwiseProduct(curve.nx()) + along.cwiseProduct(curve.tx);
    velocity.col(1) = v.cwiseProduct(curve.ny()) + along.cwiseProduct(curve.ty);
    return grid_.without_short_waves(velocity);
  }
  ClosedCurve moved(const ClosedCurve& curve, const Matrix& velocity, double dt) const {
    return {grid_, curve.x + dt * velocity.col(0), curve.y + dt * velocity.col(1)};
  }

  /// Calls f(i, j, r, (x_i - x_j) . n_i, ln(4 sin^2)) for all pairs of different points.
  template <class F>
  void for_each_pair(const ClosedCurve& curve, F&& f) const {
    const Vector ny = curve.ny();
    for (int j = 0; j < grid_.size(); ++j) {
      for (int i = 0; i < grid_.size(); ++i) {
        if (i == j) continue;
        const double dx = curve.x[i] - curve.x[j], dy = curve.y[i] - curve.y[j];
        const double sine = 2.0 * std::sin(0.5 * grid_.step() * (i - j));
        f(i, j, std::hypot(dx, dy), dx * curve.nx()[i] + dy * ny[i], 2.0 * std::log(std::abs(sine)));
      }
    }
  }
  /// S_0: of densities times |dx/d alpha|, kernel -ln(r) / 2 pi.
  Matrix single_layer(const ClosedCurve& curve) const {
    Matrix result(grid_.size(), grid_.size());
    const double h = grid_.step();
    for_each_pair(curve, [&](int i, int j, double r, double, double log) {
      result(i, j) = -(0.5 * grid_.log_weight(i - j) + h * (std::log(r) - 0.5 * log)) / two_pi;
    });
    for (int i = 0; i < grid_.size(); ++i) {
      result(i, i) = -(0.5 * grid_.log_weight(0) + h * std::log(curve.speed[i])) / two_pi;
    }
    return result;
  }
  /// Its normal derivative, less the part of half the density: -(x - y) . n_x / (2 pi r^2), which is smooth.
  Matrix harmonic_normal(const ClosedCurve& curve) const {
    Matrix result(grid_.size(), grid_.size());
    for_each_pair(curve, [&](int i, int j, double r, double across, double) {
      result(i, j) = -grid_.step() * across / (two_pi * r * r);
    });
    for (int i = 0; i < grid_.size(); ++i) result(i, i) = -grid_.step() * curve.curvature[i] / (2.0 * two_pi);
    return result;
  }
  /// Normal derivative of D mu: d/ds S_0 dmu/ds.
  Vector slope_of_double_layer(const ClosedCurve& curve, const Matrix& single, const Vector& mu) const {
    return grid_.derivative(single * grid_.derivative(mu)).cwiseQuotient(curve.speed);
  }
  /// dc/dn inside.
  Vector nutrient_slope(const ClosedCurve& curve) const {
    const int n = grid_.size();
    const double h = grid_.step();
    Matrix single(n, n), normal(n, n);
    for_each_pair(curve, [&](int i, int j, double r, double, double log) {
      const double weight = grid_.log_weight(i - j) - h * log;  // the logarithm's, less that of its plain sum
      if (i < j) {
        single(i, j) = (h * std::cyl_bessel_k(0.0, r) - 0.5 * weight * std::cyl_bessel_i(0.0, r)) / two_pi;
        // K_1(r) / r has ln(r) I_1(r) / r
        normal(i, j) = -(h * std::cyl_bessel_k(1.0, r) + 0.5 * weight * std::cyl_bessel_i(1.0, r)) / (two_pi * r);
      }
    });
    single.triangularView<Eigen::StrictlyLower>() = single.transpose();
    normal.triangularView<Eigen::StrictlyLower>() = normal.transpose();
    for_each_pair(curve, [&](int i, int j, double, double across, double) { normal(i, j) *= across; });
    for (int i = 0; i < n; ++i) {
      single(i, i) =
          (-0.5 * grid_.log_weight(0) - h * (std::log(0.5 * curve.speed[i]) + std::numbers::egamma)) / two_pi;
      normal(i, i) = -h * curve.curvature[i] / (2.0 * two_pi);
    }
    const Vector weighed = single.partialPivLu().solve(Vector::Ones(n));  // density times |dx/d alpha|
    return normal * weighed + 0.5 * weighed.cwiseQuotient(curve.speed);
  }

  Trigonometric grid_;
  PlaneTumour numbers_;
};

}  // namespace bench
