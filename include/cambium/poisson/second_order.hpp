// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace cambium {

/// The centred three-point stencils (1, -2, 1) / h^2 and (-1, 0, 1) / (2 h).
struct SecondOrder {
  static constexpr int order = 2;
  /// 2 - 2 cos theta, without cancellation at small theta
  static double second(double theta) {
    const double s = std::sin(0.5 * theta);
    return 4.0 * s * s;
  }
  static double first(double theta) { return std::sin(theta); }
};

}  // namespace cambium
