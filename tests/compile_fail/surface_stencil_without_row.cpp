// expect: cambium: a surface stencil is called as S::row<T, D>\(from, to, at, count, stride, shift\)
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/kernels/hat.hpp>
#include <cambium/surface/surface_stencil.hpp>

struct Still {
  using Kernel = cambium::Hat;
  static constexpr std::ptrdiff_t reach = 1;
  static constexpr int axes = 1;
#ifdef CAMBIUM_CONTROL
  template <class T, int D>
  static void row(const T*, T*, std::ptrdiff_t, std::ptrdiff_t, const cambium::Index<D>&, T) {}
#endif
};

int main() { cambium::check_surface_stencil<Still>(); }
