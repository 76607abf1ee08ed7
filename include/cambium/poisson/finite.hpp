// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cmath>
#include <limits>

#include <cambium/core/field.hpp>
#include <cambium/parallel/execution.hpp>

namespace cambium::detail {

/// \throws ValueError if a value of the field is not finite
template <class T, int D, Execution E>
void require_finite(const Field<T, D>& field, const E& execution) {
  std::atomic<bool> finite = true;
  for_each_piece(execution, field.size(), 4096, [&](std::size_t begin, std::size_t end) {
    bool good = true;
    for (std::size_t i = begin; i < end; ++i) good &= std::abs(field[i]) <= std::numeric_limits<T>::max();
    if (!good) finite = false;
  });
  if (finite) return;
  std::size_t i = 0;
  while (std::isfinite(field[i])) ++i;
  throw ValueError(message("the field is ", field[i], " at ", field.lattice().position(field.lattice().node(i)),
                           ": every value must be finite"));
}

}  // namespace cambium::detail
