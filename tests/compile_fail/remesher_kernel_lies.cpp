// expect: cambium: kernel does not have the moments it declares
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/interpolation/remesher.hpp>
#include <cambium/kernels/m4_prime.hpp>

// M4' keeps moments up to the second, not the third.
struct Liar {
  static constexpr int support = 4;
#ifdef CAMBIUM_CONTROL
  static constexpr int moments = 2;
#else
  static constexpr int moments = 3;
#endif
  static constexpr double value(double x) { return cambium::M4Prime::value(x); }
};

int main() {
  cambium::Remesher<Liar> remesh;
  cambium::Remesher<Liar, cambium::Split> split;
}
