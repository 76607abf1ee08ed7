// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

#include <cambium/core/vec.hpp>

namespace bench {

/// The deformation of LeVeque (1996) as a test of level sets (Enright et al. 2002): a ball pulled out into a thin sheet
/// and, from half time on, back again.
struct Deformation {
  static constexpr double period = 3.0;
  static constexpr cambium::Vec<3> centre{0.35, 0.35, 0.35};
  static constexpr double radius = 0.15;

  static cambium::Vec<3> pattern(const cambium::Vec<3>& x) {
    cambium::Vec<3> s, s2;
    for (int d = 0; d < 3; ++d) {
      s[d] = std::sin(std::numbers::pi * x[d]);
      s2[d] = 2.0 * s[d] * std::cos(std::numbers::pi * x[d]);
    }
    return {2.0 * s[0] * s[0] * s2[1] * s2[2], -s2[0] * s[1] * s[1] * s2[2], -s2[0] * s2[1] * s[2] * s[2]};
  }
  static double strength(double t) { return std::cos(std::numbers::pi * t / period); }
  static cambium::Vec<3> velocity(const cambium::Vec<3>& x, double t) { return strength(t) * pattern(x); }
  static double distance(const cambium::Vec<3>& x) { return norm(x - centre) - radius; }
};

}  // namespace bench
