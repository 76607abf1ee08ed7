// expect: cambium: PSE kernel has the wrong scale
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cambium/kernels/constant_math.hpp>
#include <cambium/kernels/gaussian_pse.hpp>
#include <cambium/kernels/pse_kernel.hpp>

// A heat kernel normalised to 1 instead of to the second moment 2.
struct Normalised {
  static constexpr int order = 2;
  static constexpr double cutoff = 6.0;
  static constexpr double largest_spacing = 0.8;
#ifdef CAMBIUM_CONTROL
  static constexpr double scale = 4.0;
#else
  static constexpr double scale = 1.0;
#endif
  template <int D>
  requires(D == 2) static constexpr double zeroth_moment = scale;
  template <int D>
  requires(D == 2) static constexpr double laplacian(double rho2) {
    return scale / 3.14159265358979324 * cambium::exponential(-rho2);
  }
  template <int D>
  requires(D == 2) static constexpr double gradient(double rho2) { return cambium::Gaussian2::gradient<2>(rho2); }
};

int main() { cambium::check_pse_kernel<Normalised>(); }
