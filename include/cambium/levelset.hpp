// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir levelset  Interfaces as signed distances in a narrow band: reinitialisation, advection, geometry, extension.
#include <cambium/levelset/advection/eulerian.hpp>
#include <cambium/levelset/band_builder.hpp>
#include <cambium/levelset/closest_point.hpp>
#include <cambium/levelset/closest_point_search.hpp>
#include <cambium/levelset/closest_points.hpp>
#include <cambium/levelset/extension/by_pde.hpp>
#include <cambium/levelset/jet.hpp>
#include <cambium/levelset/lagrangian.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/narrow_band.hpp>
#include <cambium/levelset/nearest_candidates.hpp>
#include <cambium/levelset/patch.hpp>
#include <cambium/levelset/reinit/band_work.hpp>
#include <cambium/levelset/reinit/block_activity.hpp>
#include <cambium/levelset/reinit/gradient_normalised.hpp>
#include <cambium/levelset/reinit/interface_distance.hpp>
#include <cambium/levelset/reinit/lagrangian_reinit.hpp>
#include <cambium/levelset/reinit/pde_reinit.hpp>
#include <cambium/levelset/reinit/upwind_lagrangian_reinit.hpp>
#include <cambium/levelset/reinit/volume_constraint.hpp>
#include <cambium/levelset/reinitialisation.hpp>
#include <cambium/levelset/weno.hpp>
