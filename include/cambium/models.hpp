// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir models  Whole equations as thin compositions of the rooms below. <cambium/models/tumour.hpp> is to be included
/// by name: it compiles Eigen.
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
#include <cambium/models/tumour/semi_implicit.hpp>
#include <cambium/models/tumour/short_gmres.hpp>
#include <cambium/models/tumour/sides.hpp>
