// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/levelset/measures.hpp>
#include <cambium/models/tumour.hpp>

#include "model.hpp"

namespace tumour {

/// What the pressure's source adds to the volume in a unit of time, and the volume that is necrotic.
struct Budget {
  double gain = 0.0;
  double necrotic = 0.0;
};

/// gain = integral of the source of the pressure over the inside, which is the rate of the volume whatever the speed
/// is. The source is G (1 - A) on the interface: that times the volume, and the sum over the nodes inside of what is
/// left, which vanishes there, so that cells that the interface cuts leave an error of O(h^2) without a preferred sign.
template <class T>
Budget budget(const T& tumour, double volume) {
  constexpr int D = T::dimension;
  const auto& band = tumour.level_set().band();
  const auto& p = tumour.parameters();
  const auto& c = tumour.nutrient();
  const double on_interface = p.growth * (1.0 - p.apoptosis), cell = std::pow(band.spacing(), D);
  Budget sum{on_interface * volume, 0.0};
  cambium::detail::for_each_side(band, cambium::Serial{}, [&](std::size_t i, bool inside) {
    if (!inside) return;
    sum.gain += cell * (NecrosisIfAny::source(p, c, band, i) - on_interface);
    if (p.necrotic_limit > 0.0) sum.necrotic += cell * cambium::Necrosis::share(p, c, band, i);
  });
  return sum;
}

/// Volume and, from gain to gain by the trapezoidal rule, what it should be.
template <int D>
struct Row {
  double time = 0.0;
  cambium::TumourStep step;
  cambium::Measures<D> measures;
  Budget budget;
  double expected = 0.0;

  double imbalance() const { return measures.volume / expected - 1.0; }
};

/// The time series of a run.
template <class T>
class Series {
 public:
  static constexpr int dimension = T::dimension;

  /// Measures the tumour as it is after `step`. \throws as cambium::measures()
  const Row<dimension>& take(const T& tumour, const cambium::TumourStep& step) {
    const auto measures = cambium::measures(tumour.level_set().band());
    Row<dimension> row{tumour.time(), step, measures, budget(tumour, measures.volume), 0.0};
    row.expected = any_ ? last_.expected + 0.5 * (row.time - last_.time) * (row.budget.gain + last_.budget.gain)
                        : row.measures.volume;
    any_ = true;
    return last_ = row;
  }
  const Row<dimension>& last() const { return last_; }
  /// Goes on from a tumour as it was at the last row. \param expected  volume that it should have had
  void resume(const T& tumour, double expected) {
    take(tumour, {});
    last_.expected = expected;
  }

 private:
  bool any_ = false;
  Row<dimension> last_;
};

}  // namespace tumour
