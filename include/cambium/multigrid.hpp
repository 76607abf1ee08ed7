// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir multigrid  Geometric multigrid on boxes, and Krylov loops that it preconditions. The solvers themselves,
/// <cambium/multigrid/multigrid.hpp> and <cambium/multigrid/krylov.hpp>, are to be included by name: they compile
/// Eigen.
#include <cambium/multigrid/bicgstab_loop.hpp>
#include <cambium/multigrid/chebyshev.hpp>
#include <cambium/multigrid/convergence_error.hpp>
#include <cambium/multigrid/level.hpp>
#include <cambium/multigrid/matrix_entries.hpp>
#include <cambium/multigrid/red_black.hpp>
#include <cambium/multigrid/smoother.hpp>
#include <cambium/multigrid/transfer.hpp>
#include <cambium/multigrid/wall.hpp>
