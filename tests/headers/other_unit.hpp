// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

/// Address of cambium::require_size as the other translation unit sees it.
auto require_size_of_other_unit() -> void (*)(std::size_t, std::size_t, const char*);
