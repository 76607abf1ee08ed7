// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include <cambium/core/vec.hpp>
#include <cambium/kernels/pse_kernel.hpp>

namespace cambium::detail {

/// The weights of the operators: `at` is the kernel as a function of rho^2 = |r|^2 / eps^2, `powers` the power of
/// 1 / eps, beside the eps^-D of eta_eps, in front of it for r in units of length.
struct LaplacianWeight {
  static constexpr int powers = 2;
  template <class K, int D>
  static constexpr double at(double rho2) {
    return K::template laplacian<D>(rho2);
  }
};
struct GradientWeight {
  static constexpr int powers = 2;
  template <class K, int D>
  static constexpr double at(double rho2) {
    return K::template gradient<D>(rho2);
  }
};
/// phi with int z_i^2 z_j^2 phi = 1 (i != j) and vanishing moments of degree 6, ..., order + 2. In radial coordinates
/// these are the conditions on eta two dimensions higher: int rho^(D+3) phi = pi int rho^(D+3) eta_{D+2}.
struct DiffusionWeight {
  static constexpr int powers = 4;
  template <class K, int D>
  static constexpr double at(double rho2) {
    return std::numbers::pi * K::template laplacian<D + 2>(rho2);
  }
};

/// The weight W of a pair at distance r: eps^-(D + powers) W(|r|^2 / eps^2).
template <class W, class K, int D>
class PairWeight {
 public:
  explicit PairWeight(double epsilon) : inverse_square_(1.0 / (epsilon * epsilon)) {
    for (int i = 0; i < D + W::powers; ++i) scale_ /= epsilon;
  }
  double operator()(const Vec<D>& r) const { return scale_ * W::template at<K, D>(dot(r, r) * inverse_square_); }

 private:
  double inverse_square_;
  double scale_ = 1.0;
};

template <class K, int D>
concept HasDiffusionKernel = requires(double rho2) {
  K::template laplacian<D + 2>(rho2);
};

/// int |z|^4 phi = D (D + 2), int |z|^(2m) phi = 0 for 6 <= 2m <= order + 2.
template <class K, int D>
consteval bool diffusion_moments_hold() {
  constexpr int count = K::order / 2 + 2;
  const auto found =
      radial_moments<D, count>([](double rho2) { return DiffusionWeight::template at<K, D>(rho2); }, K::cutoff);
  bool hold = nearly(found.moment[2], D * (D + 2.0));
  for (std::size_t m = 3; m < count; ++m) hold = hold && nearly(found.moment[m], 0.0);
  return hold;
}

/// One readable message for each thing anisotropic diffusion asks of a kernel beyond PSEKernel.
template <class K, int D>
constexpr void check_diffusion_kernel() {
  static_assert(HasDiffusionKernel<K, D>,
                "cambium: anisotropic diffusion in D dimensions needs a PSE kernel with laplacian<D + 2>(rho2)");
  if constexpr (HasDiffusionKernel<K, D>) {
    static_assert(diffusion_moments_hold<K, D>(),
                  "cambium: PSE kernel laplacian<D + 2> does not have the moments it declares, which anisotropic "
                  "diffusion in D dimensions needs");
  }
}

}  // namespace cambium::detail
