// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace cambium {

/// The factor chi(phi) that takes the velocity of a narrow band to zero at its edges, eq. 11.69: 1 up to `inner`, 0
/// from `outer` on, between them the cubic that joins these with continuous slope. Lengths in units of phi.
template <class T>
struct Cutoff {
  T inner;
  T outer;

  T operator()(T phi) const {
    const T distance = std::abs(phi);
    if (distance <= inner) return T(1);
    if (!(distance < outer)) return T(0);
    const T width = outer - inner;
    const T rest = (outer - distance) / width;
    return rest * rest * (T(2) * distance + outer - T(3) * inner) / width;
  }
};

}  // namespace cambium
