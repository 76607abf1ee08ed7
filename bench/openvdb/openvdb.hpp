// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

/// OpenVDB beside Cambium: arrays in, arrays out, so that its headers stay in one translation unit. All run on one
/// thread and are compiled with the flags of the program, its trackers included.
namespace bench::vdb {

/// Values at all nodes of a lattice in a box from the origin on, axis 0 fastest. Not finite: not in the narrow band;
/// the sign then tells the side.
struct Values {
  std::array<std::ptrdiff_t, 3> nodes;
  double spacing;
  std::vector<double> phi;
};

struct Advected {
  Values half;           ///< at half time
  Values end;            ///< at the end
  double seconds = 0.0;  ///< processor time of moving the level set
  std::size_t steps = 0;
};

/// LevelSetAdvection through the deformation of deformation.hpp: HJWENO5 in space, TVD RK3 in time, the tracker as it
/// is by default (three normalisations a step, HJWENO5 and Euler), bands of three voxels. It samples the velocity once
/// a step: it is given that in the middle of the step. Steps are as long as its own CFL number allows.
Advected advect_deformation(const Values& start);

enum class Scheme { first, hjweno5 };

struct Normalised {
  Values values;
  double seconds = 0.0;   ///< processor time of a call, the median of some
  std::size_t nodes = 0;  ///< active voxels
};

/// LevelSetTracker::normalize with so many iterations, TVD RK3 in pseudo-time.
Normalised normalise(const Values& start, double half_width, Scheme scheme, int iterations);

}  // namespace bench::vdb
