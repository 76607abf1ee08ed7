// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/poisson/periodic_transform.hpp>

#include "support/best_of.hpp"

namespace bench {

/// Processor time of a real transform by FFTW of n^3 values, forward and back, on one thread: the unit of time of
/// elliptic problems.
inline double pair_seconds(std::ptrdiff_t n) {
  using namespace cambium;
  const auto lattice = Lattice<3>::periodic_box(Box<3>::cube(), n);
  const PeriodicTransform<3> transform(lattice, Planning::measure);
  AlignedVector<double> x(lattice.size(), 1.0);
  AlignedVector<PeriodicTransform<3>::Complex> z(transform.size());
  return best_of(7, [&] {
    transform.forward(x.data(), z.data());
    transform.backward(z.data(), x.data());
  });
}

}  // namespace bench
