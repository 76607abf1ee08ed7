// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir levelset  Interfaces as signed distances in a narrow band: reinitialisation, advection, geometry, extension.
#include <cambium/levelset/advection/backward.hpp>
#include <cambium/levelset/advection/band_particles.hpp>
#include <cambium/levelset/advection/band_reader.hpp>
#include <cambium/levelset/advection/cell_random.hpp>
#include <cambium/levelset/advection/cutoff.hpp>
#include <cambium/levelset/advection/lagrangian.hpp>
#include <cambium/levelset/advection/markers.hpp>
#include <cambium/levelset/advection/mover.hpp>
#include <cambium/levelset/advection/particle_corrected.hpp>
#include <cambium/levelset/advection/steepest_slope.hpp>
#include <cambium/levelset/band_builder.hpp>
#include <cambium/levelset/closest_point.hpp>
#include <cambium/levelset/closest_point_search.hpp>
#include <cambium/levelset/closest_points.hpp>
#include <cambium/levelset/front.hpp>
#include <cambium/levelset/jet.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/narrow_band.hpp>
#include <cambium/levelset/nearest_candidates.hpp>
#include <cambium/levelset/patch.hpp>
#include <cambium/levelset/point_bins.hpp>
#include <cambium/levelset/reinitialisation.hpp>
