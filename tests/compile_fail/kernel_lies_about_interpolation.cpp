// expect: cambium: kernel is declared interpolating but is not
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cambium/kernels/m4.hpp>
#include <cambium/kernels/remeshing_kernel.hpp>

struct Liar {
  static constexpr int support = 4;
  static constexpr int moments = 1;
#ifdef CAMBIUM_CONTROL
  static constexpr bool interpolating = false;
#else
  static constexpr bool interpolating = true;
#endif
  static constexpr double value(double x) { return cambium::M4::value(x); }
};

int main() { cambium::check_remeshing_kernel<Liar>(); }
