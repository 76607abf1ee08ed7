// expect: cambium: kernel is not a polynomial of the degree it declares
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cambium/kernels/m4.hpp>
#include <cambium/kernels/remeshing_kernel.hpp>

struct Liar {
  static constexpr int support = 4;
  static constexpr int moments = 1;
#ifdef CAMBIUM_CONTROL
  static constexpr int degree = 3;
#else
  static constexpr int degree = 2;
#endif
  static constexpr double value(double x) { return cambium::M4::value(x); }
};

int main() { cambium::check_remeshing_kernel<Liar>(); }
