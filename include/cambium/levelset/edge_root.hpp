// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <cambium/kernels/taps.hpp>

namespace cambium::detail {

/// Where the interpolant of kernel K crosses zero between two neighbouring nodes of different sides.
///
/// On a line of the lattice an interpolating kernel sees the nodes of that line alone, so the interpolant is a
/// polynomial in one variable that has the values of the two nodes at its ends: there always is a crossing.
template <class K, class T>
class EdgeRoot {
  static_assert(K::interpolating && K::support % 2 == 0 && Taps<K>::polynomial,
                "cambium: crossings of lattice edges need an interpolating kernel of even, piecewise polynomial form");

 public:
  /// \param node    the first of the two nodes
  /// \param stride  to the next node along the edge
  /// \return distance of the crossing from the first node, in spacings, in [0, 1]
  static double find(const T* node, std::ptrdiff_t stride) {
    const bool rising = node[0] < T(0);
    const std::array<double, degree + 1> p = polynomial(node, stride);
    double low = -0.5, high = 0.5;
    const double span = static_cast<double>(node[0]) - static_cast<double>(node[stride]);
    double g = static_cast<double>(node[0]) / span - 0.5;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      double value = p[degree], slope = 0.0;
      for (int j = degree - 1; j >= 0; --j) {
        slope = slope * g + value;
        value = value * g + p[j];
      }
      ((value < 0.0) == rising ? low : high) = g;
      double next = g - value / slope;
      if (!(next >= low && next <= high)) next = 0.5 * (low + high);
      const double step = std::abs(next - g);
      g = next;
      if (step < tolerance) break;
    }
    return g + 0.5;
  }
  /// The crossing of the straight line through the two values.
  static double linear(const T* node, std::ptrdiff_t stride) {
    return static_cast<double>(node[0]) / (static_cast<double>(node[0]) - static_cast<double>(node[stride]));
  }

 private:
  static constexpr int degree = Taps<K>::degree;
  static constexpr int most_iterations = 60;  // halvings alone reach the tolerance in 40
  static constexpr double tolerance = 1e-12;

  static std::array<double, degree + 1> polynomial(const T* node, std::ptrdiff_t stride) {
    std::array<double, degree + 1> p{};
    for (int k = 0; k < K::support; ++k) {
      const auto value = static_cast<double>(node[(k - Taps<K>::before) * stride]);
      for (int j = 0; j <= degree; ++j) p[j] += Taps<K>::coefficients.value[j][k] * value;
    }
    return p;
  }
};

}  // namespace cambium::detail
