// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdio>

/// Numbers that are held against what they should be.
struct Checks {
  int failures = 0;

  void operator()(const char* what, double found, double wanted, double tolerance) {
    const bool good = std::abs(found - wanted) <= tolerance;
    std::printf("%-28s %.12g, wanted %.12g%s\n", what, found, wanted, good ? "" : ": WRONG");
    failures += good ? 0 : 1;
  }
};
