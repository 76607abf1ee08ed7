// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir io  Files for other programs; no other room includes it.
#include <cambium/io/npy.hpp>
