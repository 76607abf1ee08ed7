// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

// One of two translation units that include every header: a function or variable that is neither a template nor inline
// is then defined twice, and the program does not link.
#include "all_headers.hpp"

#include "other_unit.hpp"

int main() {
  // An inline function is one function in the whole program.
  return require_size_of_other_unit() == &cambium::require_size ? 0 : 1;
}
