// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/parallel/execution.hpp>
#include <cambium/particles/particles.hpp>

namespace cambium {

/// Calls f(p, x) for every particle p at position x. An f that writes only to attributes of p gives the same bits for
/// any number of threads.
template <int D, class T, class F, Execution E = OpenMP>
void for_each_particle(const Particles<D, T>& particles, F&& f, const E& execution = {}) {
  const Columns<D, const T> positions = particles.positions();
  for_each(execution, positions.size(), [&](std::size_t p) { f(p, positions[p]); });
}

}  // namespace cambium
