// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include <cambium/reaction/kinetics.hpp>

namespace cambium {

/// Gray & Scott (1984): substrate c_1 fed into a vessel, autocatalyst c_2 washed out of it,
///   F_1 = -c_1 c_2^2 + f (1 - c_1),   F_2 = c_1 c_2^2 - (f + k) c_2
struct GrayScott {
  static constexpr int species = 2;

  double feed;
  double kill;

  template <class T>
  constexpr Vec<2, T> operator()(const Vec<2, T>& c) const {
    const T f = static_cast<T>(feed), made = c[0] * c[1] * c[1];
    return {f * (T(1) - c[0]) - made, made - static_cast<T>(feed + kill) * c[1]};
  }
  constexpr Jacobian<2> jacobian(const Vec<2>& c) const {
    const double u = c[1] * c[1], v = 2.0 * c[0] * c[1];
    return {Vec<2>{-u - feed, -v}, Vec<2>{u, v - feed - kill}};
  }
  /// (1, 0) and, where feed >= 4 (feed + kill)^2, the two others.
  std::vector<Vec<2>> fixed_points() const {
    std::vector<Vec<2>> result{{1.0, 0.0}};
    const double loss = feed + kill, under = feed * feed - 4.0 * feed * loss * loss;
    if (under < 0.0) return result;
    for (const double sign : {-1.0, 1.0}) {
      const double c = (feed + sign * std::sqrt(under)) / (2.0 * loss);
      result.push_back({loss / c, c});
    }
    return result;
  }
};

/// Spots that divide (pattern lambda of Pearson 1993), with his diffusivities for a square of edge 2.5.
inline constexpr GrayScott pearson_spots{0.035, 0.065};
inline constexpr Vec<2> pearson_diffusivities{2e-5, 1e-5};

}  // namespace cambium
