// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <cambium/levelset/narrow_band.hpp>
#include <cambium/time/step_size.hpp>

namespace cambium::detail {

/// The largest speed of the nodes within a spacing of the interface.
template <int D>
double largest_speed(const NarrowBand<double, D>& band, const Field<double, D, Sparse>& speed) {
  double largest = 0.0;
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      if (std::abs(band.values().block(b)[i]) <= band.spacing()) {
        largest = std::max(largest, std::abs(speed.block(b)[i]));
      }
    }
  }
  return largest;
}

/// The step in which the speed changes by a share, if it goes on as in the last step, which was `last_step` long and
/// began with the speed `before`; unless what it changes by moves the interface by less than a thousandth of a spacing:
/// next to rest speeds are those of the lattice, not of the tumour. Both are root mean squares next to the interface.
template <int D>
StepSize change_limit(double share, const NarrowBand<double, D>& band, const Field<double, D, Sparse>& speed,
                      const Field<double, D, Sparse>& before, double last_step) {
  double squares = 0.0, changes = 0.0, count = 0.0;
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    const std::ptrdiff_t old = before.find(band.values().block_index(b));
    for (std::size_t i = 0; old >= 0 && i < band.volume; ++i) {
      if (std::abs(band.values().block(b)[i]) > band.spacing()) continue;
      const double now = speed.block(b)[i], then = before.block(static_cast<std::size_t>(old))[i];
      if (std::isnan(now) || std::isnan(then)) continue;
      squares += now * now;
      changes += (now - then) * (now - then);
      count += 1.0;
    }
  }
  if (!(changes > 0.0)) return {};
  const double change = std::sqrt(changes / count) / last_step;
  return {std::max(share * std::sqrt(squares / count) / change, std::sqrt(1e-3 * band.spacing() / change)),
          Limit::accuracy};
}

}  // namespace cambium::detail
