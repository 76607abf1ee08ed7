// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir particles  Particles as a structure of arrays, their order and their neighbours.
#include <cambium/particles/cell_grid.hpp>
#include <cambium/particles/cell_order.hpp>
#include <cambium/particles/for_each_particle.hpp>
#include <cambium/particles/neighbours.hpp>
#include <cambium/particles/overlap.hpp>
#include <cambium/particles/particles.hpp>
#include <cambium/particles/reconstruction.hpp>
#include <cambium/particles/totals.hpp>
#include <cambium/particles/validation.hpp>
