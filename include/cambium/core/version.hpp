// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Version of the library, for conditional compilation in user code.
#define CAMBIUM_VERSION_MAJOR 0
#define CAMBIUM_VERSION_MINOR 1
#define CAMBIUM_VERSION_PATCH 0
