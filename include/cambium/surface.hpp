// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir surface  Functions on a moving interface: diffusion, transport, integrals.
#include <cambium/surface/cell_stencil.hpp>
#include <cambium/surface/flux_laplacian.hpp>
#include <cambium/surface/group_values.hpp>
#include <cambium/surface/level_geometry.hpp>
#include <cambium/surface/particle_cells.hpp>
#include <cambium/surface/place_batch.hpp>
#include <cambium/surface/point_reader.hpp>
#include <cambium/surface/projected_laplacian.hpp>
#include <cambium/surface/sheet_builder.hpp>
#include <cambium/surface/sheet_plan.hpp>
#include <cambium/surface/sheet_points.hpp>
#include <cambium/surface/surface_band.hpp>
#include <cambium/surface/surface_exchange.hpp>
#include <cambium/surface/surface_integral.hpp>
#include <cambium/surface/surface_laplacian.hpp>
#include <cambium/surface/surface_particles.hpp>
#include <cambium/surface/surface_stencil.hpp>
#include <cambium/surface/surface_transport.hpp>
#include <cambium/surface/volume_ratio.hpp>
