// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir poisson  Poisson's equation on lattices; programs that include it link with FFTW.
#include <cambium/poisson/boundary.hpp>
#include <cambium/poisson/boundary_potential.hpp>
#include <cambium/poisson/box.hpp>
#include <cambium/poisson/box_transform.hpp>
#include <cambium/poisson/difference_symbol.hpp>
#include <cambium/poisson/edge_coupling.hpp>
#include <cambium/poisson/even_convolution.hpp>
#include <cambium/poisson/face_values.hpp>
#include <cambium/poisson/finite.hpp>
#include <cambium/poisson/fourth_order.hpp>
#include <cambium/poisson/free_space.hpp>
#include <cambium/poisson/free_space_convolution.hpp>
#include <cambium/poisson/free_space_dirichlet.hpp>
#include <cambium/poisson/free_space_kernels.hpp>
#include <cambium/poisson/free_space_spectral.hpp>
#include <cambium/poisson/lane_fft.hpp>
#include <cambium/poisson/lattice_green.hpp>
#include <cambium/poisson/line_transform.hpp>
#include <cambium/poisson/padded_fft.hpp>
#include <cambium/poisson/periodic.hpp>
#include <cambium/poisson/periodic_transform.hpp>
#include <cambium/poisson/second_order.hpp>
#include <cambium/poisson/spectral.hpp>
