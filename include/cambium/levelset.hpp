// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir levelset  Interfaces as signed distances in a narrow band: reinitialisation, advection, geometry, extension.
#include <cambium/levelset/band_builder.hpp>
#include <cambium/levelset/closest_point.hpp>
#include <cambium/levelset/closest_point_search.hpp>
#include <cambium/levelset/closest_points.hpp>
#include <cambium/levelset/jet.hpp>
#include <cambium/levelset/lagrangian.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/narrow_band.hpp>
#include <cambium/levelset/nearest_candidates.hpp>
#include <cambium/levelset/patch.hpp>
#include <cambium/levelset/reinit/block_links.hpp>
#include <cambium/levelset/reinit/bucket_heap.hpp>
#include <cambium/levelset/reinit/cell_polynomial.hpp>
#include <cambium/levelset/reinit/chopp_kick_off.hpp>
#include <cambium/levelset/reinit/crossed_nodes.hpp>
#include <cambium/levelset/reinit/distance_field.hpp>
#include <cambium/levelset/reinit/eikonal_update.hpp>
#include <cambium/levelset/reinit/fast_marching.hpp>
#include <cambium/levelset/reinit/fast_sweeping.hpp>
#include <cambium/levelset/reinit/group_marching.hpp>
#include <cambium/levelset/reinit/kick_off.hpp>
#include <cambium/levelset/reinit/linear_kick_off.hpp>
#include <cambium/levelset/reinitialisation.hpp>
