// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/core/error.hpp>
#include <cambium/core/field.hpp>
#include <cambium/parallel/execution.hpp>

namespace cambium {

/// What a periodic solver does with a right-hand side whose mean is not zero: there is no periodic solution then.
enum class MeanPart {
  reject,    ///< throw ValueError
  subtract,  ///< solve for the right-hand side less its mean
};

namespace detail {

struct MeanAndLargest {
  double sum = 0.0;
  double largest = 0.0;
  bool finite = true;
};

/// Mean of component c of a field. \throws ValueError if a value is not finite, or, with MeanPart::reject, if the mean
/// is beyond `tolerance` times the largest value
template <class V, int D, Execution E>
double examine_mean(const Field<V, D>& field, int c, MeanPart part, double tolerance, const E& execution) {
  const auto read = [&](std::size_t i) {
    const auto value = static_cast<double>(component(field[i], c));
    return MeanAndLargest{value, std::abs(value), std::isfinite(value)};
  };
  const auto join = [](const MeanAndLargest& a, const MeanAndLargest& b) {
    return MeanAndLargest{a.sum + b.sum, a.largest > b.largest ? a.largest : b.largest, a.finite && b.finite};
  };
  const MeanAndLargest found = reduce(execution, field.size(), MeanAndLargest{}, read, join);
  if (!found.finite) {
    std::size_t i = 0;
    while (std::isfinite(component(field[i], c))) ++i;
    throw ValueError(message("component ", c, " of the field is ", component(field[i], c), " at ",
                             field.lattice().position(field.lattice().node(i)), ": every value must be finite"));
  }
  const double mean = found.sum / static_cast<double>(field.size());
  if (part == MeanPart::reject && std::abs(mean) > tolerance * found.largest) {
    throw ValueError(message("the right-hand side of a periodic Poisson equation has the mean ", mean, " (component ",
                             c, ", largest value ", found.largest,
                             ") but must have none: take away what puts it there, or ask for MeanPart::subtract"));
  }
  return mean;
}

}  // namespace detail
}  // namespace cambium
