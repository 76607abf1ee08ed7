// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <cambium/models/tumour.hpp>

#include "support/clock.hpp"

namespace bench {

/// A box of edge length 2 half around 0.
template <int D>
cambium::Lattice<D> tumour_box(std::ptrdiff_t cells, double half) {
  using cambium::Vec;
  return cambium::Lattice<D>::bounded_box({Vec<D>::constant(-half), Vec<D>::constant(half)}, cells);
}

/// Runs a tumour to a time, or for `most` steps; what it came to, or why it stopped.
template <class T>
nlohmann::json grow(T& tumour, double end, int most = 1 << 30) {
  nlohmann::json result{{"cells", tumour.lattice().nodes()[0] - 1}};
  const double start = wall_seconds();
  int steps = 0, iterations = 0;
  try {
    while (end - tumour.time() > 1e-12 && steps < most && !tumour.extinct()) {
      iterations += tumour.step(end - tumour.time()).iterations;
      ++steps;
    }
  } catch (const cambium::Error& error) {
    result["stopped"] = error.what();
  }
  const auto& times = tumour.times();
  result["seconds"] = wall_seconds() - start;
  result["time"] = tumour.time();
  result["steps"] = steps;
  result["iterations"] = iterations;
  result["volume"] = measures(tumour.level_set().band()).volume;
  result["parts"] = {{"geometry", times.geometry},
                     {"nutrient", times.nutrient},
                     {"pressure", times.pressure},
                     {"implicit", times.implicit},
                     {"motion", times.motion}};
  return result;
}

}  // namespace bench
