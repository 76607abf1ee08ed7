// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir levelset  Interfaces as signed distances in a narrow band: reinitialisation, advection, geometry, extension.
#include <cambium/levelset/advection/backward.hpp>
#include <cambium/levelset/band_builder.hpp>
#include <cambium/levelset/cell_moments.hpp>
#include <cambium/levelset/closest_point.hpp>
#include <cambium/levelset/closest_point_search.hpp>
#include <cambium/levelset/closest_points.hpp>
#include <cambium/levelset/curved_element.hpp>
#include <cambium/levelset/cut_cell.hpp>
#include <cambium/levelset/disjoint_sets.hpp>
#include <cambium/levelset/edge_root.hpp>
#include <cambium/levelset/front.hpp>
#include <cambium/levelset/inside_components.hpp>
#include <cambium/levelset/interface_cells.hpp>
#include <cambium/levelset/interface_extremum.hpp>
#include <cambium/levelset/interface_integral.hpp>
#include <cambium/levelset/interface_projection.hpp>
#include <cambium/levelset/jet.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/measures.hpp>
#include <cambium/levelset/narrow_band.hpp>
#include <cambium/levelset/nearest_candidates.hpp>
#include <cambium/levelset/patch.hpp>
#include <cambium/levelset/point_bins.hpp>
#include <cambium/levelset/reinitialisation.hpp>
#include <cambium/levelset/surface.hpp>
#include <cambium/levelset/symmetric_difference.hpp>
