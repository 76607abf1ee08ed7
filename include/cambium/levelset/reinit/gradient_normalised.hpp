// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <cambium/levelset/reinit/band_work.hpp>
#include <cambium/levelset/reinitialisation.hpp>
#include <cambium/levelset/weno.hpp>

namespace cambium {

/// Reinitialisation without iteration: phi := phi / |grad phi| (Cottet & Maitre 2006). The zero set stays; the slope is
/// 1 only there: a distance s away the error is about s^2 d(log |grad phi|)/dn / 2, whatever the resolution.
///
/// |grad phi| is Godunov's, from one-sided derivatives by Scheme on the side of the interface, so that the values cut
/// off at the edge of the band do no harm.
template <class Scheme>
struct BasicGradientNormalised {
  struct Params {};

  template <class T, int D>
  class Method {
   public:
    using Band = NarrowBand<T, D>;

    Method() = default;
    explicit Method(const Params&) {}

    /// phi := phi / |grad phi|. \throws ValueError if phi is not finite
    template <Execution E>
    ReinitReport operator()(Band& band, const E& execution) {
      detail::require_finite(band, execution);
      const Band& from = detail::copy_band(band, copy_);
      patches_.resize(static_cast<std::size_t>(execution.count()));
      for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
        Patch<T, D>& patch = patches_[worker];
        patch.read_block(from, b, Scheme::reach);
        const auto phi = band.values().block(b);
        for (std::size_t i = 0; i < Band::volume; i += lanes) {
          normalise(patch.data() + patch.entry(i), patch.stride(), static_cast<T>(band.spacing()), band.half_width(),
                    phi.data() + i);
        }
      });
      return {detail::cut_off(band, execution), 0, 0, 1};
    }

   private:
    static constexpr std::size_t lanes = detail::row_lanes;
    using Lanes = simd::Pack<T, lanes>;

    static void normalise(const T* at, const Index<D>& stride, T h, T half_width, T* phi) {
      alignas(64) T value[lanes];
      for (std::size_t l = 0; l < lanes; ++l) value[l] = at[l] < T(0) ? T(-1) : T(1);
      const Lanes sign = Lanes::load_aligned(value);
      Lanes sum(T(0));
      for (int d = 0; d < D; ++d) {
        const auto differences = detail::row_differences<Scheme, lanes>(at, stride[d]);
        sum = sum + detail::godunov_square(differences.left(), differences.right(), sign);
      }
      sum.store_aligned(value);
      for (std::size_t l = 0; l < lanes; ++l) {
        const T far = at[l] < T(0) ? -half_width : half_width;
        const T slope = std::sqrt(value[l]) / h;
        if (at[l] != T(0)) phi[l] = slope * half_width > std::abs(at[l]) ? at[l] / slope : far;
      }
    }

    std::optional<Band> copy_;
    std::vector<Patch<T, D>> patches_;
  };
};

/// With fifth-order derivatives.
using GradientNormalised = BasicGradientNormalised<WENO5>;

}  // namespace cambium
