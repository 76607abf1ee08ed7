// expect: cambium: kernel value\(x\) must be a constant expression
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cambium/kernels/hat.hpp>
#include <cambium/kernels/remeshing_kernel.hpp>

struct RunTimeOnly {
  static constexpr int support = 2;
  static constexpr int moments = 1;
#ifdef CAMBIUM_CONTROL
  static constexpr double value(double x) { return cambium::Hat::value(x); }
#else
  static double value(double x) { return cambium::Hat::value(x); }
#endif
};

int main() { cambium::check_remeshing_kernel<RunTimeOnly>(); }
