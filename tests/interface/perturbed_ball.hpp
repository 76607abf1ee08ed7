// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/QR>
#include <array>
#include <cmath>
#include <numbers>

#include <cambium/core/vec.hpp>

namespace scenes {

using cambium::Vec;

/// Tissue of radius R + delta Y_l that consumes what comes from outside and grows, and its velocity V(theta): Lap c = c
/// inside, c = 1 on the interface; -Lap p = G (c - A) inside; p_in - p_out = gamma kappa; V = -dp/dn. Outside p = 0, or
/// Lap p = 0 in free space with no jump of dp/dn.
///
/// Solutions are sums of the regular (and outside the decaying) waves of the ball, fitted to the conditions at as many
/// angles: they converge exponentially with the number of waves, here to 1e-9. Y_l = cos(3 theta) in the plane,
/// P_2(cos theta) about the last axis in space.
template <int D>
class PerturbedBall {
 public:
  static constexpr int l = D == 2 ? 3 : 2;
  static constexpr double radius = 2.0, growth = 20.0, decay = 0.5, tension = 1.0;
  /// Linear stability: dV = sigma delta Y_l.
  static constexpr double sigma_free_space = D == 2 ? -0.14161408684 : -0.4157881900;
  static constexpr double sigma_zero_outside = D == 2 ? -4.23872133296 : -2.0528562326;

  explicit PerturbedBall(double delta) : delta_(delta) {
    nutrient_ = fit(waves, [&](Row& row, double& right, double theta, bool) {
      for (int k = 0; k < waves; ++k) row[k] = bessel(k, distance(theta)) * angular(k, theta);
      right = 1.0;
    });
    zero_outside_ = fit(waves, [&](Row& row, double& right, double theta, bool) {
      const double r = distance(theta);
      for (int k = 0; k < waves; ++k) row[k] = std::pow(r / radius, degree(k)) * angular(k, theta);
      right = tension * curvature_at(theta) - particular(r);
    });
    free_space_ = fit(2 * waves, [&](Row& row, double& right, double theta, bool slopes) {
      const double r = distance(theta);
      for (int k = 0; k < waves; ++k) {
        row[k] = slopes ? along_normal(theta, inner_wave(k, theta)) : inner_wave(k, theta)[0];
        row[waves + k] = -(slopes ? along_normal(theta, outer_wave(k, theta)) : outer_wave(k, theta)[0]);
      }
      right = slopes ? -along_normal(theta, source_part(theta)) : tension * curvature_at(theta) - particular(r);
    });
  }

  static Vec<D> centre() { return Vec<D>::constant(0.02) + Vec<D>::unit(0, 0.03); }
  double level_set(const Vec<D>& x) const {
    return norm(x - centre()) < 1e-3 ? -radius : norm(x - centre()) - distance(angle(x));
  }
  double curvature(const Vec<D>& x) const { return curvature_at(angle(x)); }
  double velocity_zero_outside(const Vec<D>& x) const { return velocity(angle(x), zero_outside_); }
  double velocity_free_space(const Vec<D>& x) const { return velocity(angle(x), free_space_); }

 private:
  static constexpr int waves = 16;
  using Row = Eigen::VectorXd;
  /// Value and derivatives in r and theta.
  using Wave = std::array<double, 3>;

  static double angle(const Vec<D>& x) {
    const Vec<D> y = x - centre();
    if constexpr (D == 2) return std::atan2(y[1], y[0]);
    return std::acos(y[D - 1] / norm(y));
  }
  static int degree(int k) { return l * k; }
  static double angular(int k, double theta) {
    if constexpr (D == 2) return std::cos(degree(k) * theta);
    return std::legendre(static_cast<unsigned>(degree(k)), std::cos(theta));
  }
  static double angular_slope(int k, double theta) {
    const int n = degree(k);
    if constexpr (D == 2) return -n * std::sin(n * theta);
    const double s = std::sin(theta);
    if (n == 0 || std::abs(s) < 1e-12) return 0.0;
    const double below = std::legendre(static_cast<unsigned>(n - 1), std::cos(theta));
    return n * (std::cos(theta) * angular(k, theta) - below) / s;
  }
  /// Regular solution of Lap c = c, and its derivative.
  static double raw_bessel(double order, double r) {
    return D == 2 ? std::cyl_bessel_i(order, r) : std::cyl_bessel_i(order + 0.5, r) / std::sqrt(r);
  }
  static double bessel(int k, double r) { return raw_bessel(degree(k), r) / raw_bessel(degree(k), radius); }
  static double bessel_slope(int k, double r) {
    return degree(k) / r * bessel(k, r) + raw_bessel(degree(k) + 1, r) / raw_bessel(degree(k), radius);
  }

  /// r(theta) and its derivatives.
  double distance(double theta) const { return radius + delta_ * angular(1, theta); }
  double slope(double theta) const { return delta_ * angular_slope(1, theta); }
  double bend(double theta) const {
    return D == 2 ? -delta_ * l * l * std::cos(l * theta) : -3.0 * delta_ * std::cos(2.0 * theta);
  }
  double curvature_at(double theta) const {
    const double r = distance(theta), s = slope(theta), length = std::hypot(r, s);
    const double meridian = (r * r + 2.0 * s * s - r * bend(theta)) / (length * length * length);
    if constexpr (D == 2) return meridian;
    // s cot(theta) = -3 delta cos(theta)^2 for P_2.
    const double cosine = std::cos(theta);
    return meridian + (r + 3.0 * delta_ * cosine * cosine) / (r * length);
  }

  static Wave inner_wave(int k, double r, double theta) {
    const double value = std::pow(r / radius, degree(k));
    return {value * angular(k, theta), degree(k) / r * value * angular(k, theta), value * angular_slope(k, theta)};
  }
  Wave inner_wave(int k, double theta) const { return inner_wave(k, distance(theta), theta); }
  Wave outer_wave(int k, double theta) const {
    const double r = distance(theta);
    if (D == 2 && k == 0) return {std::log(r / radius), 1.0 / r, 0.0};
    const int power = degree(k) + D - 2;
    const double value = std::pow(r / radius, -power);
    return {value * angular(k, theta), -power / r * value * angular(k, theta), value * angular_slope(k, theta)};
  }
  /// -G c + G A r^2 / (2 D), on the interface.
  static double particular(double r) { return -growth + growth * decay * r * r / (2.0 * D); }
  Wave source_part(double theta) const {
    const double r = distance(theta);
    Wave sum{particular(r), growth * decay * r / D, 0.0};
    for (int k = 0; k < waves; ++k) {
      sum[1] -= growth * nutrient_[k] * bessel_slope(k, r) * angular(k, theta);
      sum[2] -= growth * nutrient_[k] * bessel(k, r) * angular_slope(k, theta);
    }
    return sum;
  }
  double along_normal(double theta, const Wave& wave) const {
    const double r = distance(theta), tilt = slope(theta) / r;
    return (wave[1] - tilt * wave[2] / r) / std::hypot(1.0, tilt);
  }
  double velocity(double theta, const Row& waves_inside) const {
    double sum = along_normal(theta, source_part(theta));
    for (int k = 0; k < waves; ++k) sum += waves_inside[k] * along_normal(theta, inner_wave(k, theta));
    return -sum;
  }

  /// Unknowns from one condition, or two, at each of the angles.
  template <class F>
  static Row fit(int unknowns, F&& condition) {
    Eigen::MatrixXd matrix(unknowns, unknowns);
    Row right(unknowns);
    for (int i = 0; i < unknowns; ++i) {
      const double theta = std::numbers::pi / l * (i % waves + 0.5) / waves;
      Row row(unknowns);
      condition(row, right[i], theta, i >= waves);
      matrix.row(i) = row.transpose();
    }
    return matrix.colPivHouseholderQr().solve(right);
  }

  double delta_;
  Row nutrient_, zero_outside_, free_space_;
};

}  // namespace scenes
