// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>

#include <cambium/levelset/measures.hpp>
#include <cambium/models/tumour.hpp>

namespace tumour {

/// What the pressure's source adds to the volume in a unit of time, and the volume that is necrotic.
struct Budget {
  double gain = 0.0;
  double necrotic = 0.0;
};

namespace detail {

/// Share of the cell around a node that is inside.
template <int D>
double share_inside(const cambium::NarrowBand<double, D>& band, const cambium::Index<D>& node, bool inside) {
  const double h = band.spacing(), phi = band(node);
  if (std::abs(phi) > h * D) return inside ? 1.0 : 0.0;
  cambium::Vec<D> slope;
  for (int d = 0; d < D; ++d) {
    const auto step = cambium::Index<D>::unit(d);
    slope[d] = 0.5 * (band(band.inside(node + step)) - band(band.inside(node - step)));
  }
  return cambium::detail::share_below(slope, -phi);
}

}  // namespace detail

/// Sums over the cells around nodes: gain = integral of the source of the pressure over the inside, which is the rate
/// of the volume whatever the speed is; cells that the interface cuts count by their share. Error O(h^2).
template <class T>
Budget budget(const T& tumour) {
  constexpr int D = T::dimension;
  const auto& band = tumour.level_set().band();
  const auto& p = tumour.parameters();
  const auto& c = tumour.nutrient();
  const double cell = std::pow(band.spacing(), D);
  Budget sum;
  cambium::detail::for_each_side(band, cambium::Serial{}, [&](std::size_t i, bool inside) {
    const double share = detail::share_inside(band, c.lattice().node(i), inside);
    if (!(share > 0.0)) return;
    const double dead = inside && p.necrotic_limit > 0.0 ? cambium::Necrosis::share(p, c, band, i) : 0.0;
    const double living = p.growth * (std::isfinite(c[i]) ? c[i] - p.apoptosis : 1.0 - p.apoptosis);
    sum.gain += share * cell * ((1.0 - dead) * living - dead * p.growth * p.necrotic_decay);
    sum.necrotic += share * cell * dead;
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
    Row<dimension> row{tumour.time(), step, cambium::measures(tumour.level_set().band()), budget(tumour), 0.0};
    row.expected = any_ ? last_.expected + 0.5 * (row.time - last_.time) * (row.budget.gain + last_.budget.gain)
                        : row.measures.volume;
    any_ = true;
    return last_ = row;
  }
  const Row<dimension>& last() const { return last_; }

 private:
  bool any_ = false;
  Row<dimension> last_;
};

}  // namespace tumour
