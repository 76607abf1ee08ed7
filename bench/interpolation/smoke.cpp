// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/kernel_contests.hpp"
#include "interpolation/remeshing.hpp"

/// One kernel in 2D, so that a test of the program compiles in seconds.
void bench::enter_contests(const Options& options) {
  using cambium::M4Prime;
  InterpolationContest<M4Prime, 2> contest("M4Prime", Way::p2m, options);
  contest.add<double>();
  contest.enter();
  ThreadsContest<M4Prime, 2> threads("M4Prime", Way::p2m, options);
  threads.add<double, 1>();
  threads.enter();
  enter_remeshing_error<M4Prime>("M4Prime", options);
}
