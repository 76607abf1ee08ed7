// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir interface  Conditions on the interface of a level set for elliptic problems: jumps, Dirichlet values, forces
/// spread from it, fluxes. Those that compile Eigen are to be included by name: <cambium/interface/dirichlet.hpp>,
/// <cambium/interface/neumann.hpp> and <cambium/interface/right_hand_side_gmres.hpp>.
#include <cambium/interface/aggregation_cycle.hpp>
#include <cambium/interface/cell_domain.hpp>
#include <cambium/interface/cell_geometry.hpp>
#include <cambium/interface/checked_fields.hpp>
#include <cambium/interface/continuation.hpp>
#include <cambium/interface/cut_domain.hpp>
#include <cambium/interface/cut_rows.hpp>
#include <cambium/interface/finite_volumes.hpp>
#include <cambium/interface/fitted_gradient.hpp>
#include <cambium/interface/images.hpp>
#include <cambium/interface/immersed_boundary.hpp>
#include <cambium/interface/interface_gradient.hpp>
#include <cambium/interface/jump.hpp>
#include <cambium/interface/jump_data.hpp>
#include <cambium/interface/jump_geometry.hpp>
#include <cambium/interface/jump_legs.hpp>
#include <cambium/interface/jump_mayo.hpp>
#include <cambium/interface/jump_patch.hpp>
#include <cambium/interface/jump_rule.hpp>
#include <cambium/interface/node_sides.hpp>
#include <cambium/interface/side.hpp>
