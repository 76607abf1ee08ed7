// expect: cambium: PSE kernel does not have the order it declares
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cambium/kernels/gaussian_pse.hpp>
#include <cambium/kernels/pse_kernel.hpp>

// The Gaussian itself is of second order.
struct Liar : cambium::Gaussian2 {
#ifdef CAMBIUM_CONTROL
  static constexpr int order = 2;
#else
  static constexpr int order = 4;
#endif
  template <int D>
  static constexpr double gradient(double rho2) {
    return cambium::Gaussian4::gradient<D>(rho2);
  }
};

int main() { cambium::check_pse_kernel<Liar>(); }
