// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <cambium/levelset/closest_point_step.hpp>
#include <cambium/levelset/patch.hpp>

namespace cambium::detail {

/// The closest point on the zero set of the function that kernel K interpolates from a patch.
///
/// By closest_point_step; lengths in spacings.
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
      Vec<D, T> step = closest_point_step(jet_, x - at, mu);
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

  const Patch<T, D>& patch_;
  T reach_;
  Jet<T, D> jet_;
};

}  // namespace cambium::detail
