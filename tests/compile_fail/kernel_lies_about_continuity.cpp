// expect: cambium: kernel is not of the continuity class it declares
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cambium/kernels/m4_prime.hpp>
#include <cambium/kernels/remeshing_kernel.hpp>

// The second derivative of M4' jumps at 1 and at 2.
struct Liar {
  static constexpr int support = 4;
  static constexpr int moments = 2;
#ifdef CAMBIUM_CONTROL
  static constexpr int continuity = 1;
#else
  static constexpr int continuity = 2;
#endif
  static constexpr auto pieces = cambium::M4Prime::pieces;
  static constexpr double value(double x) { return pieces(x); }
};

int main() { cambium::check_remeshing_kernel<Liar>(); }
