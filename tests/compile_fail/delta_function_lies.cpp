// expect: cambium: delta function does not satisfy the even-odd condition
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cambium/kernels/delta3.hpp>
#include <cambium/kernels/delta_function.hpp>

// In three points only the outer pair can be told from the middle, and the middle weighs 1/3 to 2/3.
struct Liar {
  static constexpr int support = 3;
  static constexpr int moments = 1;
  static constexpr int continuity = 1;
#ifdef CAMBIUM_CONTROL
  static constexpr bool even_odd = false;
#else
  static constexpr bool even_odd = true;
#endif
  static constexpr double value(double x) { return cambium::Delta3::value(x); }
};

int main() { cambium::check_delta_function<Liar>(); }
