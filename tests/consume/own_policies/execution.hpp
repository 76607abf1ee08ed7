// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/parallel/execution.hpp>

/// As many threads as half of those that OpenMP would take, and one: Execution.
struct HalfOfThem {
  int count() const { return cambium::OpenMP{}.count() / 2 + 1; }
};
