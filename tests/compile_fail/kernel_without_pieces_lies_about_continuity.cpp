// expect: cambium: kernel is not of the continuity class it declares
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cambium/kernels/delta4.hpp>
#include <cambium/kernels/remeshing_kernel.hpp>

// The second derivative of Peskin's four-point function jumps at 2; it is found from values alone.
struct Liar {
  static constexpr int support = 4;
  static constexpr int moments = 1;
#ifdef CAMBIUM_CONTROL
  static constexpr int continuity = 1;
#else
  static constexpr int continuity = 2;
#endif
  static constexpr double value(double x) { return cambium::Delta4::value(x); }
};

int main() { cambium::check_remeshing_kernel<Liar>(); }
