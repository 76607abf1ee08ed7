// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/kernels.hpp>

#include "interpolation/options.hpp"
#include "interpolation/remeshing.hpp"

void bench::enter_contests(const Options& options) {
  using namespace cambium;
  enter_kernel<M4Prime>("M4Prime", options);
  enter_kernel<M6>("M6", options);
  // Particles of half of the cells along an axis still exceed the second cache, and are measured eight times faster.
  Options fewer = options;
  fewer.rounds = options.rounds_of_others;
  fewer.cells_2d /= 2;
  fewer.cells_3d /= 2;
  enter_kernel<Hat>("Hat", fewer);
  enter_kernel<M3>("M3", fewer);
  enter_kernel<M4>("M4", fewer);
  enter_kernel<Lambda<2, 2>>("Lambda22", fewer);
  enter_kernel<M6TriplePrime>("M6TriplePrime", fewer);
  enter_kernel<Lambda<4, 4>>("Lambda44", fewer);
  enter_kernel<Lambda<6, 4>>("Lambda64", fewer);
  enter_kernel<Lambda<8, 4>>("Lambda84", fewer);
  enter_remeshing<M4Prime>("M4Prime", options);
  enter_remeshing<M6>("M6", options);
  enter_remeshing<Lambda<4, 4>>("Lambda44", options);
  enter_remeshing_error<M4Prime>("M4Prime", options);
  enter_remeshing_error<M6>("M6", options);
  enter_remeshing_error<Lambda<4, 4>>("Lambda44", options);
}
