// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir particles  Particles as a structure of arrays, their order and their neighbours.
#include <cambium/particles/particles.hpp>
