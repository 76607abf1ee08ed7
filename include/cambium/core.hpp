// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir core  Geometry of uniform lattices, fields on them, errors.
#include <cambium/core/aligned.hpp>
#include <cambium/core/box.hpp>
#include <cambium/core/columns.hpp>
#include <cambium/core/domain.hpp>
#include <cambium/core/error.hpp>
#include <cambium/core/field.hpp>
#include <cambium/core/lattice.hpp>
#include <cambium/core/snapshot.hpp>
#include <cambium/core/sparse.hpp>
#include <cambium/core/vec.hpp>
#include <cambium/core/version.hpp>
