// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "other_unit.hpp"

#include "all_headers.hpp"

auto require_size_of_other_unit() -> void (*)(std::size_t, std::size_t, const char*) { return &cambium::require_size; }
