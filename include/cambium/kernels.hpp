// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir kernels  Remeshing kernels, mollifiers, kernels of particle strength exchange, delta functions.
#include <cambium/kernels/algebraic_pse.hpp>
#include <cambium/kernels/constant_math.hpp>
#include <cambium/kernels/continuity_check.hpp>
#include <cambium/kernels/delta3.hpp>
#include <cambium/kernels/delta4.hpp>
#include <cambium/kernels/delta6.hpp>
#include <cambium/kernels/delta_cosine.hpp>
#include <cambium/kernels/delta_function.hpp>
#include <cambium/kernels/gaussian_mollifier.hpp>
#include <cambium/kernels/gaussian_pse.hpp>
#include <cambium/kernels/hat.hpp>
#include <cambium/kernels/kernel_checks.hpp>
#include <cambium/kernels/lagrange4.hpp>
#include <cambium/kernels/lagrange6.hpp>
#include <cambium/kernels/lambda.hpp>
#include <cambium/kernels/lambda21.hpp>
#include <cambium/kernels/lambda22.hpp>
#include <cambium/kernels/lambda42.hpp>
#include <cambium/kernels/lambda44.hpp>
#include <cambium/kernels/lambda64.hpp>
#include <cambium/kernels/lambda84.hpp>
#include <cambium/kernels/m3.hpp>
#include <cambium/kernels/m4.hpp>
#include <cambium/kernels/m4_prime.hpp>
#include <cambium/kernels/m6.hpp>
#include <cambium/kernels/m6_triple_prime.hpp>
#include <cambium/kernels/mollifier.hpp>
#include <cambium/kernels/piecewise_polynomial.hpp>
#include <cambium/kernels/pse_kernel.hpp>
#include <cambium/kernels/radial_gaussian.hpp>
#include <cambium/kernels/radial_moments.hpp>
#include <cambium/kernels/remeshing_kernel.hpp>
#include <cambium/kernels/taps.hpp>
