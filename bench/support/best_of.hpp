// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "support/clock.hpp"

namespace bench {

/// Least processor time of `runs` calls of f, in seconds.
template <class F>
double best_of(int runs, F&& f) {
  double best = 1e300;
  for (int k = 0; k < runs; ++k) {
    const double start = cpu_seconds();
    f();
    best = std::min(best, cpu_seconds() - start);
  }
  return best;
}

}  // namespace bench
