// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir operators  Derivatives on lattices and on particles.
#include <cambium/operators/difference_rows.hpp>
#include <cambium/operators/difference_weights.hpp>
#include <cambium/operators/differences.hpp>
