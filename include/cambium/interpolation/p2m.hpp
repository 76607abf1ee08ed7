// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/interpolation/interpolator.hpp>

namespace cambium {

/// mesh_i := sum_p strength_p W((x_i - x_p) / h); see Interpolator::p2m. Loops keep an Interpolator, whose buffers
/// last.
template <RemeshingKernel Kernel, int D, class P, class A, class V, class S, Execution E = OpenMP>
void p2m(const Particles<D, P>& particles, Attribute<A> strength, Field<V, D, S>& mesh, const E& execution = {}) {
  Interpolator<Kernel>().p2m(particles, strength, mesh, execution);
}

/// mesh_i := sum_p value_p W / sum_p W; see Interpolator::p2m_renormalised.
template <RemeshingKernel Kernel, int D, class P, class A, class V, class S, Execution E = OpenMP>
Coverage p2m_renormalised(const Particles<D, P>& particles, Attribute<A> value, Field<V, D, S>& mesh,
                          const RenormalisedParams<V>& params = {}, const E& execution = {}) {
  return Interpolator<Kernel>().p2m_renormalised(particles, value, mesh, params, execution);
}

}  // namespace cambium
