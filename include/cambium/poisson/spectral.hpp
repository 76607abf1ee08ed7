// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cambium {

/// Exact derivatives of the trigonometric polynomial through the nodes.
struct Spectral {
  static constexpr int order = 0;
  static double second(double theta) { return theta * theta; }
  static double first(double theta) { return theta; }
};

}  // namespace cambium
