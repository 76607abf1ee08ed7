// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <cambium/kernels/lambda.hpp>
#include <cambium/levelset/jet.hpp>
#include <cambium/levelset/reinit/band_work.hpp>
#include <cambium/levelset/reinitialisation.hpp>
#include <cambium/time/rk4.hpp>

namespace cambium {

/// Options of LagrangianReinit.
struct LagrangianReinitParams {
  /// Pseudo-time steps a call.
  int iterations = 12;
  /// Pseudo-time step; slopes g next to the interface go to g exp((1 - g) dtau) in one, which is stable below 2 and
  /// converges fastest at 1.
  double dtau = 1.0;
  /// Particles that would go further than this in one step, in spacings, are slowed down.
  double longest_shift = 2.0;
};

/// Reinitialisation by advection: d phi / d tau + w . grad phi = 0 with velocity w = (phi - phi / |grad phi|) n, which
/// is d phi / d tau = phi (1 - |grad phi|) without a source term (Bergdorf, Milde & Koumoutsakos, proposed below eq.
/// 11.34). Particles that arrive at the nodes are followed back through the velocity of the last step by stepper S, on
/// the interpolant of kernel K, and take its value there.
///
/// It carries values, it does not make any: where |grad phi| is below 1, distances as large as wanted must be found
/// further out. Elsewhere the half width is put at once.
template <class K = Lambda<4, 4>, template <class, class> class S = RK4>
struct LagrangianReinit {
  using Params = LagrangianReinitParams;

  template <class T, int D>
  class Method {
   public:
    using Band = NarrowBand<T, D>;

    Method() = default;
    /// \throws ValueError for options out of range
    explicit Method(const Params& params) : params_(params) {
      if (params.iterations < 1 || !(params.dtau > 0.0) || !(params.longest_shift > 0.0) ||
          !std::isfinite(params.dtau) || !std::isfinite(params.longest_shift)) {
        throw ValueError(detail::message("Lagrangian reinitialisation with ", params.iterations, " iterations of ",
                                         params.dtau, " and shifts up to ", params.longest_shift,
                                         " spacings: they must be at least 1, positive and positive"));
      }
    }

    /// phi := distance, as far as the iterations carry it. \throws ValueError if phi is not finite
    template <Execution E>
    ReinitReport operator()(Band& band, const E& execution) {
      detail::require_finite(band, execution);
      Band& next = detail::copy_band(band, next_);
      while (workers_.size() < static_cast<std::size_t>(execution.count())) {
        workers_.push_back(std::make_unique<Worker>());
      }
      for (int iteration = 0; iteration < params_.iterations; ++iteration) {
        for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t w, std::size_t b, std::size_t) {
          trace(band, b, *workers_[w], next.values().block(b).data());
        });
        std::swap(band, next);
      }
      return {detail::cut_off(band, execution), 0, 0, static_cast<std::size_t>(params_.iterations)};
    }

   private:
    using Kernel = Interpolant<K, T, D>;

    struct Worker {
      Worker() : stepper(positions(), Serial{}) {}
      Columns<D, T> positions() {
        std::array<T*, D> first;
        for (int d = 0; d < D; ++d) first[d] = x[d].data();
        return {first, Band::volume};
      }
      std::array<std::array<T, Band::volume>, D> x{};
      std::array<bool, Band::volume> moves{};
      Patch<T, D> patch;
      S<Columns<D, T>, Serial> stepper;
    };

    /// Values that arrive at the nodes of block b.
    void trace(const Band& band, std::size_t b, Worker& worker, T* result) const {
      const auto halo = static_cast<std::ptrdiff_t>(std::ceil(params_.longest_shift)) + K::support / 2 + 1;
      Patch<T, D>& patch = worker.patch;
      patch.read_block(band, b, std::max<std::ptrdiff_t>(halo, 2));
      bool any = false;
      for (std::size_t i = 0; i < Band::volume; ++i) {
        const std::ptrdiff_t at = patch.entry(i);
        worker.positions().set(i, patch.position(at));
        worker.moves[i] = near_band(patch.data() + at, patch.stride(), band.half_width());
        any |= worker.moves[i];
        result[i] = patch[at];
      }
      if (!any) return;
      const T h = static_cast<T>(band.spacing());
      worker.stepper.step(worker.positions(), 0.0, params_.dtau, [&](const auto& x, double, auto&& rate) {
        for (std::size_t i = 0; i < Band::volume; ++i) {
          rate.set(i, worker.moves[i] ? -velocity(patch, x[i], h) : Vec<D, T>{});
        }
      });
      for (std::size_t i = 0; i < Band::volume; ++i) {
        if (worker.moves[i]) result[i] = Kernel::value(patch.data(), patch.stride(), worker.positions()[i]);
      }
    }
    static bool near_band(const T* at, const Index<D>& stride, T half_width) {
      bool near = std::abs(at[0]) < half_width;
      for (int d = 0; d < D; ++d) {
        for (const std::ptrdiff_t s : {-2, -1, 1, 2}) near |= std::abs(at[s * stride[d]]) < half_width;
      }
      return near;
    }
    /// phi (1 - 1 / |grad phi|) n in spacings, slowed down to the longest shift; none where phi is flat.
    Vec<D, T> velocity(const Patch<T, D>& patch, const Vec<D, T>& x, T h) const {
      const Jet<T, D> jet = Kernel::jet(patch.data(), patch.stride(), x);
      const T slope = norm(jet.gradient);
      if (!(slope > flat * h)) return Vec<D, T>{};
      const Vec<D, T> w = (jet.value * (slope - h) / (h * slope * slope)) * jet.gradient;
      const T shift = norm(w) * static_cast<T>(params_.dtau);
      const T longest = static_cast<T>(params_.longest_shift);
      return shift > longest ? (longest / shift) * w : w;
    }
    /// Slopes below this have no direction.
    static constexpr T flat = T(1e-3);

    Params params_;
    std::optional<Band> next_;
    std::vector<std::unique_ptr<Worker>> workers_;
  };
};

}  // namespace cambium
