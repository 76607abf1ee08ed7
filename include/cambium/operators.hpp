// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir operators  Derivatives of fields on lattices and of functions carried by particles.
///
/// Discretisation-corrected PSE needs Eigen and is included by itself: <cambium/operators/dcpse.hpp>.
#include <cambium/operators/differences.hpp>
#include <cambium/operators/monomials.hpp>
#include <cambium/operators/pse.hpp>
#include <cambium/operators/weighted_rows.hpp>
