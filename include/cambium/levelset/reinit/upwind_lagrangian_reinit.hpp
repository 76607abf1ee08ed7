// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <cambium/kernels/lambda.hpp>
#include <cambium/levelset/jet.hpp>
#include <cambium/levelset/reinit/band_work.hpp>
#include <cambium/levelset/reinitialisation.hpp>
#include <cambium/levelset/weno.hpp>

namespace cambium {

/// Options of UpwindLagrangianReinit.
struct UpwindLagrangianReinitParams {
  /// Pseudo-time steps a call; 0 for as many as carry information from the interface three times over the band.
  int iterations = 0;
  /// Perturbations of phi move by |phi| dtau in a step: at most so many spacings. dtau itself is at most 1.
  double cfl = 0.5;
};

/// LagrangianReinit made stable: grad phi of the velocity (phi - phi / |grad phi|) n is taken from the side of the
/// interface by Scheme, pseudo-time steps are local, min(1, cfl h / |phi|), and three of them make one of TVD RK3.
/// Particles go back along straight lines and take their value by kernel K.
///
/// The nodes next to the interface keep their sign, but not their ratio: where phi is badly scaled along the interface,
/// the interface moves as with a plain PDE, and the convergence next to it is no faster.
template <class K = Lambda<4, 4>, class Scheme = WENO5>
struct UpwindLagrangianReinit {
  using Params = UpwindLagrangianReinitParams;

  template <class T, int D>
  class Method {
   public:
    using Band = NarrowBand<T, D>;

    Method() = default;
    /// \throws ValueError for options out of range
    explicit Method(const Params& params) : params_(params) {
      if (params.iterations < 0 || !(params.cfl > 0.0) || !(params.cfl <= 1.0)) {
        throw ValueError(detail::message("Lagrangian reinitialisation with ", params.iterations, " iterations at CFL ",
                                         params.cfl, ": they must be at least 0, and in (0, 1]"));
      }
    }

    /// phi := distance, as far as the iterations carry it. \throws ValueError if phi is not finite
    template <Execution E>
    ReinitReport operator()(Band& band, const E& execution) {
      detail::require_finite(band, execution);
      Band& first = detail::copy_band(band, first_);
      Band& second = detail::copy_band(band, second_);
      patches_.resize(static_cast<std::size_t>(execution.count()));
      int iterations = params_.iterations;
      if (iterations == 0) {
        const double width = static_cast<double>(band.half_width()) / band.spacing();
        iterations = static_cast<int>(std::ceil(3.0 * width / params_.cfl));
      }
      for (int iteration = 0; iteration < iterations; ++iteration) {
        stage(band, band, T(1), first, execution);
        stage(first, band, T(1) / T(4), second, execution);
        stage(second, band, T(2) / T(3), band, execution);
      }
      return {detail::cut_off(band, execution), 0, 0, static_cast<std::size_t>(iterations)};
    }

   private:
    using Kernel = Interpolant<K, T, D>;
    using Lanes = simd::Pack<T, detail::row_lanes>;
    static constexpr std::size_t lanes = detail::row_lanes;
    /// Particles go no further than this in one step, in spacings.
    static constexpr std::ptrdiff_t longest_shift = 1;

    /// One-sided derivatives of the nodes of a row, in spacings.
    struct Slopes {
      alignas(64) T left[D][lanes];
      alignas(64) T right[D][lanes];
    };

    /// to := (1 - weight) base + weight (what `from` brings to the nodes); `to` may be `base`.
    template <Execution E>
    void stage(const Band& from, const Band& base, T weight, Band& to, const E& execution) {
      constexpr std::ptrdiff_t halo = std::max<std::ptrdiff_t>(Scheme::reach, longest_shift + K::support / 2 + 1);
      const T h = static_cast<T>(from.spacing());
      for_each_piece_by_worker(execution, from.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
        Patch<T, D>& patch = patches_[worker];
        patch.read_block(from, b, halo);
        const auto old = base.values().block(b);
        const auto result = to.values().block(b);
        for (std::size_t i = 0; i < Band::volume; i += lanes) {
          const std::ptrdiff_t entry = patch.entry(i);
          const bool active = detail::smallest_around<lanes>(patch.data() + entry, patch.stride()) < from.half_width();
          Slopes slopes;
          if (active) find_slopes(patch.data() + entry, patch.stride(), slopes);
          for (std::size_t l = 0; l < lanes; ++l) {
            const std::ptrdiff_t at = entry + static_cast<std::ptrdiff_t>(l);
            const T value = active ? arriving(patch, at, slopes, l, h) : far(patch[at], from.half_width());
            result[i + l] = active ? (T(1) - weight) * old[i + l] + weight * value : value;
          }
        }
      });
    }
    static T far(T phi, T half_width) { return std::clamp(phi, T(-2) * half_width, T(2) * half_width); }
    static void find_slopes(const T* at, const Index<D>& stride, Slopes& slopes) {
      for (int d = 0; d < D; ++d) {
        const auto differences = detail::row_differences<Scheme, lanes>(at, stride[d]);
        differences.left().store_aligned(slopes.left[d]);
        differences.right().store_aligned(slopes.right[d]);
      }
    }
    /// phi where the particle that arrives at a node comes from.
    T arriving(const Patch<T, D>& patch, std::ptrdiff_t at, const Slopes& slopes, std::size_t l, T h) const {
      const T phi = patch[at];
      const T sign = phi < T(0) ? T(-1) : T(1);
      Vec<D, T> gradient{};
      for (int d = 0; d < D; ++d) {
        const T behind = std::max(sign * slopes.left[d][l], T(0));
        const T ahead = std::max(-sign * slopes.right[d][l], T(0));
        gradient[d] = behind > ahead ? slopes.left[d][l] : ahead > T(0) ? slopes.right[d][l] : T(0);
      }
      const T slope = norm(gradient);
      if (!(slope > T(1e-3) * h)) return phi;
      const T dtau = std::min(T(1), static_cast<T>(params_.cfl) * h / std::max(std::abs(phi), h * T(1e-6)));
      Vec<D, T> shift = (dtau * phi * (slope - h) / (h * slope * slope)) * gradient;
      const T length = norm(shift);
      if (length > static_cast<T>(longest_shift)) shift *= static_cast<T>(longest_shift) / length;
      return Kernel::value(patch.data(), patch.stride(), patch.position(at) - shift);
    }

    Params params_;
    std::optional<Band> first_;
    std::optional<Band> second_;
    std::vector<Patch<T, D>> patches_;
  };
};

}  // namespace cambium
