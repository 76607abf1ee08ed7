// expect: cambium: mollifier does not have the order it declares
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cambium/kernels/gaussian_mollifier.hpp>
#include <cambium/kernels/mollifier.hpp>

// Laguerre's polynomial of the three-dimensional mollifier used in two dimensions.
struct Liar {
  static constexpr int order = 4;
  static constexpr double cutoff = 6.5;
  template <int D>
  requires(D == 2) static constexpr double radial(double rho2) {
#ifdef CAMBIUM_CONTROL
    return cambium::detail::radial_gaussian<D>(cambium::GaussianMollifier<4>::polynomial<2>, rho2);
#else
    return cambium::detail::radial_gaussian<D>(cambium::GaussianMollifier<4>::polynomial<3>, rho2);
#endif
  }
};

int main() { cambium::check_mollifier<Liar>(); }
