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
#include <cambium/levelset/reinitialisation.hpp>
#include <cambium/levelset/sampler.hpp>
#include <cambium/levelset/shapes/amorphous.hpp>
#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/levelset/shapes/combination.hpp>
#include <cambium/levelset/shapes/cuboid.hpp>
#include <cambium/levelset/shapes/cylinder.hpp>
#include <cambium/levelset/shapes/dumbbell.hpp>
#include <cambium/levelset/shapes/ellipsoid.hpp>
#include <cambium/levelset/shapes/facet_point.hpp>
#include <cambium/levelset/shapes/facet_tree.hpp>
#include <cambium/levelset/shapes/half_space.hpp>
#include <cambium/levelset/shapes/image.hpp>
#include <cambium/levelset/shapes/mesh_shape.hpp>
#include <cambium/levelset/shapes/motion.hpp>
#include <cambium/levelset/shapes/shape.hpp>
#include <cambium/levelset/shapes/surface_mesh.hpp>
#include <cambium/levelset/shapes/torus.hpp>
#include <cambium/levelset/shapes/zalesak_disk.hpp>
