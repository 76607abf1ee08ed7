// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir simd  Fixed numbers of lanes on any hardware; the only room that names xsimd.
#include <cambium/simd/lane.hpp>
#include <cambium/simd/pack.hpp>
#include <cambium/simd/stream.hpp>
#include <cambium/simd/transpose.hpp>
