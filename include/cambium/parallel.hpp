// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir parallel  Loops over nodes, blocks and particles; serial or threaded, with the same bits.
#include <cambium/parallel/compensated_sum.hpp>
#include <cambium/parallel/execution.hpp>
#include <cambium/parallel/nodes.hpp>
