// expect: cambium: a remeshing kernel needs static constexpr int support
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cambium/kernels/hat.hpp>
#include <cambium/kernels/remeshing_kernel.hpp>

struct Nameless {
#ifdef CAMBIUM_CONTROL
  static constexpr int support = 2;
#endif
  static constexpr int moments = 1;
  static constexpr double value(double x) { return cambium::Hat::value(x); }
};

int main() { cambium::check_remeshing_kernel<Nameless>(); }
