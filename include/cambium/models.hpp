// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir models  Whole equations as thin compositions. <cambium/models/implicit_diffusion.hpp> stands apart: it compiles
/// Eigen.
#include <cambium/models/band_velocity.hpp>
#include <cambium/models/chemistry_steps.hpp>
#include <cambium/models/smooth_noise.hpp>
#include <cambium/models/surface_chemistry.hpp>
#include <cambium/models/surface_motion.hpp>
#include <cambium/models/surface_pattern.hpp>
