// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/interpolation/interpolator.hpp>

namespace cambium {

/// value_p := sum_i mesh_i W((x_i - x_p) / h); see Interpolator::m2p. Loops keep an Interpolator, whose buffers last.
template <RemeshingKernel Kernel, int D, class P, class A, class V, class S, Execution E = OpenMP>
void m2p(const Field<V, D, S>& mesh, Particles<D, P>& particles, Attribute<A> value, const E& execution = {}) {
  Interpolator<Kernel>().m2p(mesh, particles, value, execution);
}

}  // namespace cambium
