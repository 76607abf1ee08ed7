// expect: cambium: kernel is not an even function that vanishes outside its declared support
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cambium/kernels/m4.hpp>
#include <cambium/kernels/remeshing_kernel.hpp>

struct Liar {
#ifdef CAMBIUM_CONTROL
  static constexpr int support = 4;
#else
  static constexpr int support = 3;
#endif
  static constexpr int moments = 1;
  static constexpr double value(double x) { return cambium::M4::value(x); }
};

int main() { cambium::check_remeshing_kernel<Liar>(); }
