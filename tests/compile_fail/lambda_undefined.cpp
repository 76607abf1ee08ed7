// expect: cambium: there is no kernel Lambda<p, r> with these numbers
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cambium/kernels/lambda.hpp>

// p = 4 needs p <= 2 r + 1, that is r >= 2.
#ifdef CAMBIUM_CONTROL
int main() { return cambium::Lambda<4, 2>::support - 6; }
#else
int main() { return cambium::Lambda<4, 1>::support - 6; }
#endif
