// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The quadratic B-spline, of three points: DeltaFunction.
struct QuadraticSpline {
  static constexpr int support = 3;
  static constexpr int moments = 1;
  static constexpr int continuity = 1;
  static constexpr bool interpolating = false;

  template <class T>
  static constexpr T value(T x) {
    if (x < T(0)) x = -x;
    if (x < T(0.5)) return T(0.75) - x * x;
    return x < T(1.5) ? T(0.5) * (T(1.5) - x) * (T(1.5) - x) : T(0);
  }
};
