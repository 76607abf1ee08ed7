// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir interface  Conditions on an interface for elliptic problems: jumps, forces spread from it.
#include <cambium/interface/immersed_boundary.hpp>
#include <cambium/interface/jump.hpp>
#include <cambium/interface/jump_data.hpp>
#include <cambium/interface/jump_geometry.hpp>
#include <cambium/interface/jump_legs.hpp>
#include <cambium/interface/jump_mayo.hpp>
#include <cambium/interface/jump_patch.hpp>
#include <cambium/interface/jump_rule.hpp>
