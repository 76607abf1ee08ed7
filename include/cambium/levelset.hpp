// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir levelset  Interfaces as signed distances in a narrow band: reinitialisation, advection, geometry, extension.
#include <cambium/levelset/band_builder.hpp>
#include <cambium/levelset/band_field.hpp>
#include <cambium/levelset/closest_point.hpp>
#include <cambium/levelset/closest_point_search.hpp>
#include <cambium/levelset/closest_point_walk.hpp>
#include <cambium/levelset/closest_points.hpp>
#include <cambium/levelset/extension/by_closest_point.hpp>
#include <cambium/levelset/extension/extension.hpp>
#include <cambium/levelset/field_patch.hpp>
#include <cambium/levelset/geometry/at_closest_points.hpp>
#include <cambium/levelset/geometry/band_geometry.hpp>
#include <cambium/levelset/geometry/centred_differences.hpp>
#include <cambium/levelset/geometry/difference_geometry.hpp>
#include <cambium/levelset/geometry/gradient_range.hpp>
#include <cambium/levelset/geometry/ridge_aware.hpp>
#include <cambium/levelset/geometry/surface_geometry.hpp>
#include <cambium/levelset/jet.hpp>
#include <cambium/levelset/lagrangian.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/narrow_band.hpp>
#include <cambium/levelset/nearest_candidates.hpp>
#include <cambium/levelset/nearest_points.hpp>
#include <cambium/levelset/patch.hpp>
#include <cambium/levelset/point_box.hpp>
#include <cambium/levelset/reinitialisation.hpp>
