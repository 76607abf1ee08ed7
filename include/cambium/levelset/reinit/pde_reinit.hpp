// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <cambium/levelset/reinit/block_activity.hpp>
#include <cambium/levelset/reinit/interface_distance.hpp>
#include <cambium/levelset/reinit/volume_constraint.hpp>
#include <cambium/levelset/reinitialisation.hpp>

namespace cambium {

/// How a reinitialisation by PDE treats nodes next to the interface.
enum class SubcellFix {
  none,           ///< like all others: upwind stencils cross the interface and move it
  russo_smereka,  ///< pulled to a distance taken from phi_0 (Russo & Smereka 2000): second order
  high_order      ///< the interface is a node of their stencils (du Chene, Min & Gibou 2008): fourth order
};

/// Options of PdeReinit.
struct PdeReinitParams {
  /// Pseudo-time steps a call; 0 for as many as carry information from the interface twice over the band.
  int iterations = 0;
  /// Pseudo-time step over spacing.
  double cfl = 0.5;
  SubcellFix subcell_fix = SubcellFix::none;
  /// Keep the volume in every cell (Sussman & Fatemi 1999).
  bool volume_constraint = false;
};

/// Reinitialisation by the partial differential equation
///   d phi / d tau = S(phi_0) (1 - |grad phi|)
/// (Sussman, Smereka & Osher 1994): TVD RK3 in pseudo-time, one-sided derivatives by Scheme (Jiang & Peng 2000) in
/// Godunov's Hamiltonian, S = phi_0 / sqrt(phi_0^2 + |grad phi_0|^2 h^2) (Peng et al. 1999), or the sign of phi_0 if
/// there is a subcell fix.
///
/// Without a subcell fix the interface moves at every call, the more the rougher it is, and spheres shrink: what is
/// lost follows from the iterations of all calls together. Subcell fixes keep it in place; WENO5 with the one of high
/// order may then come to rest at one of several discrete solutions, off by some 0.03 h at a few nodes, if phi_0 is
/// steep.
template <class Scheme = WENO5>
struct PdeReinit {
  using Params = PdeReinitParams;

  template <class T, int D>
  class Method {
   public:
    using Band = NarrowBand<T, D>;

    Method() = default;
    /// \throws ValueError for options out of range
    explicit Method(const Params& params) : params_(params) {
      if (params.iterations < 0 || !(params.cfl > 0.0) || !(params.cfl <= 1.0)) {
        throw ValueError(detail::message("reinitialisation by PDE with ", params.iterations, " iterations at CFL ",
                                         params.cfl, ": they must be at least 0, and in (0, 1]"));
      }
    }

    /// phi := distance, as far as the iterations carry it. \throws ValueError if phi is not finite
    template <Execution E>
    ReinitReport operator()(NarrowBand<T, D>& band, const E& execution) {
      detail::require_finite(band, execution);
      detail::copy_band(band, first_);
      detail::copy_band(band, second_);
      patches_.resize(static_cast<std::size_t>(execution.count()));
      find_signs(band, execution);
      activity_.start(band, execution);
      if (params_.volume_constraint) constraint_.start(band, execution);
      const int iterations = iterations_for(band);
      for (int iteration = 0; iteration < iterations; ++iteration) {
        stage(band, 0, band, T(1), *first_, 1, execution);
        stage(*first_, 1, band, T(1) / T(4), *second_, 2, execution);
        stage(*second_, 2, band, T(2) / T(3), band, 0, execution);
        if (!params_.volume_constraint) continue;
        constraint_(band, *first_, execution);
        std::swap(band, *first_);
      }
      return {detail::cut_off(band, execution), 0, 0, static_cast<std::size_t>(iterations)};
    }

   private:
    static constexpr std::size_t lanes = detail::row_lanes;
    using Lanes = simd::Pack<T, lanes>;

    int iterations_for(const Band& band) const {
      if (params_.iterations > 0) return params_.iterations;
      return static_cast<int>(std::ceil(2.0 * static_cast<double>(band.half_width()) / (params_.cfl * band.spacing())));
    }

    template <Execution E>
    void find_signs(const Band& band, const E& execution) {
      sign_.resize(band.blocks() * Band::volume);
      if (params_.subcell_fix != SubcellFix::none) near_.resize(band.blocks());
      for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
        Patch<T, D>& patch = patches_[worker];
        patch.read_block(band, b, detail::NearNodes<T, D>::reach);
        T* sign = sign_.data() + b * Band::volume;
        for (std::size_t i = 0; i < Band::volume; ++i) {
          const T* at = patch.data() + patch.entry(i);
          if (params_.subcell_fix != SubcellFix::none) {
            sign[i] = at[0] < T(0) ? T(-1) : T(1);
          } else {
            const T length = std::sqrt(at[0] * at[0] + detail::centred_square<T, D>(at, patch.stride()));
            sign[i] = length > T(0) ? at[0] / length : T(0);
          }
        }
        if (params_.subcell_fix != SubcellFix::none) near_.find(band, b, patch);
      });
    }

    /// to := (1 - weight) base + weight (from + dtau S (1 - |grad from|)); `to` may be `base`. The numbers tell the
    /// buffers apart.
    template <Execution E>
    void stage(const Band& from, std::size_t from_number, const Band& base, T weight, Band& to, std::size_t to_number,
               const E& execution) {
      const T half_width = from.half_width();
      constexpr std::ptrdiff_t halo = std::max(Scheme::reach, detail::NearNodes<T, D>::reach);
      for_each_piece_by_worker(execution, from.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
        const auto result = to.values().block(b);
        if (activity_(from_number, b)) {
          patches_[worker].read_block(from, b, halo);
          stage_of_block(patches_[worker], b, base.values().block(b).data(), weight, result.data(),
                         static_cast<T>(from.spacing()), half_width);
        } else {
          std::ranges::transform(from.values().block(b), result.begin(), [&](T phi) { return far(phi, half_width); });
        }
        activity_.note(to_number, b, to);
      });
    }
    /// What nodes take that are so far from the band that their values do not matter: bounded, so that no large jumps
    /// stand beside the band.
    static T far(T phi, T half_width) { return std::clamp(phi, T(-2) * half_width, T(2) * half_width); }
    void stage_of_block(const Patch<T, D>& patch, std::size_t b, const T* base, T weight, T* to, T h,
                        T half_width) const {
      const T step = static_cast<T>(params_.cfl) * h;
      const T* sign = sign_.data() + b * Band::volume;
      const auto relax = [&](std::size_t i, T now, T rate) {
        return (T(1) - weight) * base[i] + weight * (now + step * rate);
      };
      // What the loop over all nodes must not overwrite if `to` is `base`.
      alignas(64) std::array<T, Band::volume> next;
      for (std::size_t i = 0; i < Band::volume; i += lanes) {
        const T* at = patch.data() + patch.entry(i);
        if (!(detail::smallest_around<lanes>(at, patch.stride()) < half_width)) {
          for (std::size_t l = 0; l < lanes; ++l) next[i + l] = far(at[l], half_width);
          continue;
        }
        alignas(64) T square[lanes];
        gradient_square(at, patch.stride(), sign + i).store_aligned(square);
        for (std::size_t l = 0; l < lanes; ++l) {
          next[i + l] = relax(i + l, at[l], sign[i + l] * (T(1) - std::sqrt(square[l]) / h));
        }
      }
      if (params_.subcell_fix != SubcellFix::none) {
        for (const detail::NearNode<T, D>& near : near_[b]) {
          const T* at = patch.data() + patch.entry(near.node);
          next[near.node] = relax(near.node, at[0], near_rate(near, at, patch.stride(), h));
        }
      }
      std::copy(next.begin(), next.end(), to);
    }
    static Lanes gradient_square(const T* at, const Index<D>& stride, const T* sign) {
      const Lanes huge(T(1e30));
      const Lanes way = max(Lanes(T(-1)), min(Lanes(T(1)), Lanes::load_aligned(sign) * huge));
      Lanes sum(T(0));
      for (int d = 0; d < D; ++d) {
        const auto differences = detail::row_differences<Scheme, lanes>(at, stride[d]);
        sum = sum + detail::godunov_square(differences.left(), differences.right(), way);
      }
      return sum;
    }
    T near_rate(const detail::NearNode<T, D>& near, const T* at, const Index<D>& stride, T h) const {
      if (params_.subcell_fix == SubcellFix::russo_smereka) return (near.distance - at[0]) / h;
      return near.step * near.sign * (T(1) - detail::subcell_gradient<Scheme>(near, at, stride, h) / h);
    }

    Params params_;
    std::optional<Band> first_;
    std::optional<Band> second_;
    AlignedVector<T> sign_;
    detail::NearNodes<T, D> near_;
    detail::BlockActivity<T, D> activity_;
    detail::VolumeConstraint<T, D> constraint_;
    std::vector<Patch<T, D>> patches_;
  };
};

}  // namespace cambium
