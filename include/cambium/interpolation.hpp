// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir interpolation  From particles to a mesh, from a mesh to particles, remeshing.
#include <cambium/interpolation/interpolator.hpp>
#include <cambium/interpolation/m2p.hpp>
#include <cambium/interpolation/p2m.hpp>
#include <cambium/interpolation/placement.hpp>
#include <cambium/interpolation/plain.hpp>
#include <cambium/interpolation/remesher.hpp>
