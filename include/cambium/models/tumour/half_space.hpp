// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <cambium/core/vec.hpp>

namespace cambium::detail {

/// Integral over the unit cube around 0 of max(0, distance - n . x)^P / P!:
///   1 / ((D + P)! n_1 ... n_D) sum over corners s of s_1 ... s_D max(0, distance + s . n / 2)^(D + P).
/// Components below 1e-3 of the largest are raised to that, which moves the plane by less than a thousandth.
/// \tparam P  0: share of the cube where n . x < distance; 1: what a linear function has there
template <int P, int D>
double cube_below(Vec<D> n, double distance) {
  static_assert(P == 0 || P == 1);
  double largest = 0.0, reach = 0.0, scale = 1.0;
  for (int d = 0; d < D; ++d) largest = std::max(largest, n[d] = std::abs(n[d]));
  const double whole = P == 0 ? 1.0 : distance;
  if (!(largest > 0.0)) return distance > 0.0 ? whole : 0.0;
  for (int d = 0; d < D; ++d) {
    n[d] = std::max(n[d], 1e-3 * largest);
    reach += 0.5 * n[d];
    scale *= n[d] * (d + 1);
  }
  if (distance >= reach) return whole;
  if (distance <= -reach) return 0.0;
  for (int p = 1; p <= P; ++p) scale *= D + p;
  double sum = 0.0;
  for (int corner = 0; corner < 1 << D; ++corner) {
    double place = distance, sign = 1.0;
    for (int d = 0; d < D; ++d) {
      const double s = (corner >> d) % 2 != 0 ? 1.0 : -1.0;
      place += 0.5 * s * n[d];
      sign *= s;
    }
    if (place > 0.0) sum += sign * std::pow(place, D + P);
  }
  return P == 0 ? std::clamp(sum / scale, 0.0, 1.0) : std::max(sum / scale, 0.0);
}

}  // namespace cambium::detail
