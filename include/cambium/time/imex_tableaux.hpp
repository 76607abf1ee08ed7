// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace cambium {

/// Two Runge-Kutta methods that share their stages, one explicit and one diagonally implicit.
template <int Stages>
struct IMEXTableau {
  using Row = std::array<double, static_cast<std::size_t>(Stages)>;
  std::array<Row, static_cast<std::size_t>(Stages)> explicit_part, implicit_part;
  Row explicit_weight, implicit_weight;
  Row error_weight;  ///< result minus that of the embedded method, of both parts; zero without one
  Row time;          ///< of the stages, in steps
};

/// Second order in two implicit stages, stiffly accurate and L-stable (Ascher, Ruuth & Spiteri 1997, section 2.6).
struct ARS222 {
  static constexpr int order = 2, stages = 3, error_order = 0;
  static constexpr IMEXTableau<3> tableau = [] {
    constexpr double g = 0.2928932188134524756;  // 1 - 1/sqrt(2)
    constexpr double d = 1.0 - 1.0 / (2.0 * g);
    return IMEXTableau<3>{{{{0.0, 0.0, 0.0}, {g, 0.0, 0.0}, {d, 1.0 - d, 0.0}}},
                          {{{0.0, 0.0, 0.0}, {0.0, g, 0.0}, {0.0, 1.0 - g, g}}},
                          {d, 1.0 - d, 0.0},
                          {0.0, 1.0 - g, g},
                          {0.0, 0.0, 0.0},
                          {0.0, g, 1.0}};
  }();
};

/// ARK3(2)4L[2]SA: third order in three implicit stages, with an embedded method of second order; stiffly accurate and
/// L-stable (Kennedy & Carpenter 2003, appendix C).
struct ARK3 {
  static constexpr int order = 3, stages = 4, error_order = 3;
  static constexpr IMEXTableau<4> tableau = [] {
    constexpr double g = 1767732205903.0 / 4055673282236.0;
    constexpr double b1 = 1471266399579.0 / 7840856788654.0, b2 = -4482444167858.0 / 7529755066697.0;
    constexpr double b3 = 11266239266428.0 / 11593286722821.0;
    return IMEXTableau<4>{{{{0.0, 0.0, 0.0, 0.0},
                            {1767732205903.0 / 2027836641118.0, 0.0, 0.0, 0.0},
                            {5535828885825.0 / 10492691773637.0, 788022342437.0 / 10882634858940.0, 0.0, 0.0},
                            {6485989280629.0 / 16251701735622.0, -4246266847089.0 / 9704473918619.0,
                             10755448449292.0 / 10357097424841.0, 0.0}}},
                          {{{0.0, 0.0, 0.0, 0.0},
                            {g, g, 0.0, 0.0},
                            {2746238789719.0 / 10658868560708.0, -640167445237.0 / 6845629431997.0, g, 0.0},
                            {b1, b2, b3, g}}},
                          {b1, b2, b3, g},
                          {b1, b2, b3, g},
                          {b1 - 2756255671327.0 / 12835298489170.0, b2 + 10771552573575.0 / 22201958757719.0,
                           b3 - 9247589265047.0 / 10645013368117.0, g - 2193209047091.0 / 5459859503100.0},
                          {0.0, 2.0 * g, 0.6, 1.0}};
  }();
};

}  // namespace cambium
