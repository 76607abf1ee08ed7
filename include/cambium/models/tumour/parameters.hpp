// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/core/error.hpp>

namespace cambium {

/// Numbers of the tumour model, with lengths in units of the nutrient's diffusion length and times in units of
/// mitosis (11.61-11.63). Growth without necrosis and with it have the source's values.
struct TumourParameters {
  double apoptosis = 0.5;       ///< A: rate of death relative to that of growth
  double growth = 20.0;         ///< G
  double necrotic_decay = 1.0;  ///< G_N: loss of volume in the necrotic core, relative to G
  double necrotic_limit = 0.5;  ///< N: cells die where the nutrient is below it; read with Necrosis alone
  /// gamma: p_in - p_out = gamma kappa, kappa being the sum of the principal curvatures. A source that takes their
  /// mean in space has twice this value.
  double tension = 1.0;

  /// The source's tumours that only grow (figures of its section 5.4.1).
  static TumourParameters growing(double tension = 1.0) { return {.tension = tension}; }
  /// Those with a core below N = 0.25, 0.5 or 0.75.
  static TumourParameters necrotic(double limit, double tension = 1.0) {
    return {.necrotic_limit = limit, .tension = tension};
  }
  /// Surface tension alone (section 5.3.1): no growth, no loss.
  static TumourParameters relaxing(double tension = 1.0) { return {.growth = 0.0, .tension = tension}; }

  friend bool operator==(const TumourParameters&, const TumourParameters&) = default;
};

/// \throws ValueError if a number is not finite, the tension, growth or loss negative, or the limit not in [0, 1)
inline void require_parameters(const TumourParameters& p) {
  const auto finite = {p.apoptosis, p.growth, p.necrotic_decay, p.necrotic_limit, p.tension};
  bool good = p.growth >= 0.0 && p.necrotic_decay >= 0.0 && p.tension >= 0.0;
  for (const double value : finite) good = good && std::isfinite(value);
  if (good && p.necrotic_limit >= 0.0 && p.necrotic_limit < 1.0) return;
  throw ValueError(detail::message("tumour with A = ", p.apoptosis, ", G = ", p.growth, ", G_N = ", p.necrotic_decay,
                                   ", N = ", p.necrotic_limit, ", gamma = ", p.tension,
                                   ": all must be finite, G, G_N and gamma not negative, N from 0 to below 1"));
}

}  // namespace cambium
