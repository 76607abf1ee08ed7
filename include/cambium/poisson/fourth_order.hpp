// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace cambium {

/// The centred five-point stencils (-1, 16, -30, 16, -1) / (12 h^2) and (1, -8, 0, 8, -1) / (12 h).
struct FourthOrder {
  static constexpr int order = 4;
  /// (15 - 16 cos theta + cos 2 theta) / 6 = 4 s^2 (1 + s^2 / 3), s = sin(theta / 2)
  static double second(double theta) {
    const double s = std::sin(0.5 * theta);
    return 4.0 * s * s * (1.0 + s * s / 3.0);
  }
  /// (8 sin theta - sin 2 theta) / 6
  static double first(double theta) { return std::sin(theta) * (4.0 - std::cos(theta)) / 3.0; }
};

}  // namespace cambium
