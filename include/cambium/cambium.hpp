// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file cambium.hpp  The whole library, but for <cambium/operators/dcpse.hpp>, <cambium/multigrid/multigrid.hpp>,
/// <cambium/multigrid/krylov.hpp>, <cambium/interface/dirichlet.hpp>, <cambium/interface/neumann.hpp>,
/// <cambium/interface/right_hand_side_gmres.hpp>, <cambium/models/implicit_diffusion.hpp> and
/// <cambium/models/tumour.hpp>: only their users compile Eigen. Programs link with FFTW.
#include <cambium/core.hpp>
#include <cambium/farfield.hpp>
#include <cambium/interface.hpp>
#include <cambium/interpolation.hpp>
#include <cambium/io.hpp>
#include <cambium/kernels.hpp>
#include <cambium/levelset.hpp>
#include <cambium/models.hpp>
#include <cambium/multigrid.hpp>
#include <cambium/operators.hpp>
#include <cambium/parallel.hpp>
#include <cambium/particles.hpp>
#include <cambium/poisson.hpp>
#include <cambium/reaction.hpp>
#include <cambium/simd.hpp>
#include <cambium/surface.hpp>
#include <cambium/time.hpp>
