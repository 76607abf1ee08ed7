// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/core/vec.hpp>

namespace support {

/// A smooth function without symmetries, its gradient and (s - Lap) of it: exp(x) sin(2 y + z) + x^2 z, z = 0.3 in 2D.
template <int D>
struct Manufactured {
  using Place = cambium::Vec<D>;
  double shift = 0.0;

  static double height(const Place& x) { return D == 3 ? x[D - 1] : 0.3; }
  static double value(const Place& x) {
    return std::exp(x[0]) * std::sin(2.0 * x[1] + height(x)) + x[0] * x[0] * height(x);
  }
  static Place gradient(const Place& x) {
    const double e = std::exp(x[0]);
    const double angle = 2.0 * x[1] + height(x);
    Place result;
    result[0] = e * std::sin(angle) + 2.0 * x[0] * height(x);
    result[1] = 2.0 * e * std::cos(angle);
    if (D == 3) result[D - 1] = e * std::cos(angle) + x[0] * x[0];
    return result;
  }
  double right_side(const Place& x) const {
    const double wave = std::exp(x[0]) * std::sin(2.0 * x[1] + height(x));
    const double laplacian = (D == 3 ? -4.0 : -3.0) * wave + 2.0 * height(x);
    return shift * value(x) - laplacian;
  }
};

}  // namespace support
