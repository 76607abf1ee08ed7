// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <cambium/levelset/jet.hpp>
#include <cambium/levelset/patch.hpp>

namespace cambium {

/// Sum of the principal curvatures of the level through the point of a jet, div(grad p / |grad p|), per spacing:
/// (D - 1) / R for a ball of radius R. Infinite or NaN where the gradient vanishes.
template <class T, int D>
T curvature(const Jet<T, D>& jet) {
  const T square = dot(jet.gradient, jet.gradient);
  T trace{}, along{};
  for (int d = 0; d < D; ++d) {
    trace += jet.hessian[d][d];
    along += jet.gradient[d] * dot(jet.hessian[d], jet.gradient);
  }
  return (trace - along / square) / std::sqrt(square);
}

namespace detail {

/// Moves points near the interface onto the zero set of kernel K's interpolant, along its gradient.
///
/// Every step solves the second-order Taylor polynomial along the normal (Halley's method), so that the error after a
/// step of length s is of order s^3: the step from the middle of a chord of length h is h^2 / 8R, its error O(h^6).
template <class K, class T, int D>
class InterfaceProjection {
 public:
  /// Nodes that a patch needs around the cell of a starting point.
  static constexpr std::ptrdiff_t halo = std::max(Interpolant<K, T, D>::before, Interpolant<K, T, D>::behind) + 1;

  /// \param accept  length of a step after which no further one is taken, in spacings
  explicit InterfaceProjection(const Patch<T, D>& patch, T accept = T(0.05)) : patch_(patch), accept_(accept) {}

  /// \param y  point in spacings from entry 0 of the patch; unchanged if no point within `reach` is found
  bool operator()(Vec<D, T>& y) const {
    Vec<D, T> at = y;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      const Jet<T, D> jet = Interpolant<K, T, D>::jet(patch_.data(), patch_.stride(), at);
      const T slope = norm(jet.gradient);
      if (!(slope > T(0))) return false;
      const Vec<D, T> n = jet.gradient / slope;
      T bend{};
      for (int d = 0; d < D; ++d) bend += n[d] * dot(jet.hessian[d], n);
      const T discriminant = slope * slope - T(2) * jet.value * bend;
      const T step = T(-2) * jet.value / (slope + std::sqrt(discriminant > T(0) ? discriminant : slope * slope));
      at += std::clamp(step, -longest_step, longest_step) * n;
      if (!(norm(at - y) < reach)) return false;
      if (std::abs(step) < accept_) {
        y = at;
        return true;
      }
    }
    return false;
  }

 private:
  static constexpr int most_iterations = 8;
  static constexpr T longest_step = T(0.5);
  static constexpr T reach = T(0.9);

  const Patch<T, D>& patch_;
  T accept_;
};

}  // namespace detail

}  // namespace cambium
