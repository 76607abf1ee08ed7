// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir interpolation  From particles to a mesh, from a mesh to particles, remeshing.
#include <cambium/interpolation/axis.hpp>
#include <cambium/interpolation/plain.hpp>
