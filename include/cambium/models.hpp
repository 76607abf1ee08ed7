// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir models  Whole equations as thin compositions of the rooms below. Those that compile Eigen are to be included by
/// name: <cambium/models/implicit_diffusion.hpp> and <cambium/models/tumour.hpp>.
#include <cambium/models/band_velocity.hpp>
#include <cambium/models/chemistry_steps.hpp>
#include <cambium/models/motion_by_species.hpp>
#include <cambium/models/smooth_noise.hpp>
#include <cambium/models/surface_chemistry.hpp>
#include <cambium/models/surface_motion.hpp>
#include <cambium/models/surface_pattern.hpp>
#include <cambium/models/tumour/adams_bashforth.hpp>
#include <cambium/models/tumour/along_normals.hpp>
#include <cambium/models/tumour/free_space.hpp>
#include <cambium/models/tumour/gaussian_filter.hpp>
#include <cambium/models/tumour/growth.hpp>
#include <cambium/models/tumour/heun.hpp>
#include <cambium/models/tumour/jump_pressure.hpp>
#include <cambium/models/tumour/necrosis.hpp>
#include <cambium/models/tumour/parameters.hpp>
#include <cambium/models/tumour/periodic.hpp>
#include <cambium/models/tumour/policy.hpp>
#include <cambium/models/tumour/sides.hpp>
#include <cambium/models/tumour/speed_limits.hpp>
#include <cambium/models/tumour/value_at.hpp>
