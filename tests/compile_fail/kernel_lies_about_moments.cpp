// expect: cambium: kernel does not have the moments it declares
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cambium/kernels/m4.hpp>
#include <cambium/kernels/remeshing_kernel.hpp>

// The cubic B-spline keeps the total and the first moment, but not the second.
struct Liar {
  static constexpr int support = 4;
#ifdef CAMBIUM_CONTROL
  static constexpr int moments = 1;
#else
  static constexpr int moments = 2;
#endif
  static constexpr double value(double x) { return cambium::M4::value(x); }
};

int main() { cambium::check_remeshing_kernel<Liar>(); }
