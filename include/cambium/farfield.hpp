// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir farfield  Potentials of particles in free space: through a mesh, by a tree, by the plain sum.
#include <cambium/farfield/cluster_tree.hpp>
#include <cambium/farfield/direct_potential.hpp>
#include <cambium/farfield/expansion.hpp>
#include <cambium/farfield/expansion_reach.hpp>
#include <cambium/farfield/particle_mesh_potential.hpp>
#include <cambium/farfield/plane_expansion.hpp>
#include <cambium/farfield/space_expansion.hpp>
#include <cambium/farfield/tree_potential.hpp>
