// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

/// The compact fourth-order stencil (1 + delta^2 / 12)^-1 delta^2: DifferenceSymbol.
struct Compact {
  static constexpr int order = 4;
  static double second(double theta) { return 12.0 * (1.0 - std::cos(theta)) / (5.0 + std::cos(theta)); }
  static double first(double theta) { return 3.0 * std::sin(theta) / (2.0 + std::cos(theta)); }
};
