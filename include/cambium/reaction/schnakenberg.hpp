// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <cambium/reaction/kinetics.hpp>

namespace cambium {

/// Schnakenberg (1979): the simplest autocatalysis with a Turing instability,
///   F_1 = gamma (a - c_1 + c_1^2 c_2),   F_2 = gamma (b - c_1^2 c_2)
/// with a, b >= 0 and a + b > 0.
struct Schnakenberg {
  static constexpr int species = 2;

  double a;
  double b;
  double gamma = 1.0;

  template <class T>
  constexpr Vec<2, T> operator()(const Vec<2, T>& c) const {
    const T g = static_cast<T>(gamma), made = c[0] * c[0] * c[1];
    return {g * (static_cast<T>(a) - c[0] + made), g * (static_cast<T>(b) - made)};
  }
  constexpr Jacobian<2> jacobian(const Vec<2>& c) const {
    const double u = 2.0 * c[0] * c[1], v = c[0] * c[0];
    return {Vec<2>{gamma * (u - 1.0), gamma * v}, Vec<2>{-gamma * u, -gamma * v}};
  }
  /// c_1 = a + b, c_2 = b / c_1^2.
  std::vector<Vec<2>> fixed_points() const { return {{a + b, b / ((a + b) * (a + b))}}; }
};

/// a = 0.1, b = 0.9 (Madzvamuse, Wathen & Maini 2003); gamma and the ratio d = 10 of the diffusivities are theirs, too.
inline constexpr Schnakenberg schnakenberg_spots{0.1, 0.9, 29.0};
inline constexpr Vec<2> schnakenberg_diffusivities{1.0, 10.0};

}  // namespace cambium
