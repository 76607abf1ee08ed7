// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include <cambium/levelset/extension/extension.hpp>
#include <cambium/levelset/field_patch.hpp>
#include <cambium/levelset/patch.hpp>
#include <cambium/levelset/weno.hpp>

namespace cambium {

/// Options of ByPde.
struct ByPdeParams {
  /// Pseudo-time steps; 0 for as many as carry information from the interface twice over the band.
  int iterations = 0;
  /// Pseudo-time step over spacing; at most 1 / D.
  double cfl = 0.3;
};

/// Extension off the interface by the partial differential equation
///   dc / dtau + S(phi) grad phi . grad c = 0
/// (Bergdorf, Milde & Koumoutsakos, eq. 11.47; Peng et al. 1999), S = phi / sqrt(phi^2 + |grad phi|^2 h^2): upwind
/// derivatives by Scheme, forward Euler for first order and TVD RK3 for the others.
///
/// Takes `from` at one node on either side of the interface (Upwind1) or as many as the stencil of the scheme. With
/// this S and Upwind1 those two nodes settle at the linear interpolation to the interface, second order. Wider stencils
/// across the interface settle at another mean of their nodes: smaller errors at usual resolutions, but of first order.
template <class Scheme = Upwind1>
struct ByPde {
  using Params = ByPdeParams;

  template <class T, int D>
  class Method {
   public:
    using Band = NarrowBand<T, D>;

    Method() = default;
    /// \throws ValueError for options out of range
    explicit Method(const Params& params) : params_(params) {
      if (params.iterations < 0 || !(params.cfl > 0.0) || !(params.cfl <= 1.0 / D)) {
        throw ValueError(detail::message("extension by PDE with ", params.iterations, " iterations at CFL ", params.cfl,
                                         ": they must be at least 0, and in (0, 1 / ", D, "]"));
      }
    }

    /// to := `from`, constant along normals in the band; elsewhere as it is.
    /// \throws SizeError unless `from` has the blocks of the band; ValueError if `from` and `to` are one field
    template <class V, Execution E>
    void operator()(const Band& band, const Field<V, D, Sparse>& from, Field<V, D, Sparse>& to, const E& execution) {
      static_assert(std::is_same_v<ScalarOf<V>, T>, "cambium: the field must have the scalar type of the level set");
      require_same_blocks(from, band, "the field to extend");
      if (&from == &to) throw ValueError("the field to extend is also the result: give two fields");
      take_blocks(to, band);
      fit(band, execution);
      find_velocity(band, execution);
      for (int c = 0; c < Components<V>::count; ++c) {
        copy(execution, [&](std::size_t b, std::size_t i) { fields_[0].block(b)[i] = component(from.block(b)[i], c); });
        iterate(band, execution);
        copy(execution, [&](std::size_t b, std::size_t i) { component(to.block(b)[i], c) = fields_[0].block(b)[i]; });
      }
    }

   private:
    static constexpr std::size_t lanes = detail::row_lanes;
    static constexpr std::ptrdiff_t halo = std::max<std::ptrdiff_t>(Scheme::reach, 2);
    using Lanes = simd::Pack<T, lanes>;
    using Scalars = Field<T, D, Sparse>;

    template <Execution E>
    void fit(const Band& band, const E& execution) {
      while (fields_.size() < (Scheme::order == 1 ? 2 : 3)) fields_.emplace_back(band.lattice());
      for (Scalars& field : fields_) take_blocks(field, band);
      for (auto& column : velocity_) column.resize(band.blocks() * Band::volume);
      patches_.resize(static_cast<std::size_t>(execution.count()));
      field_patches_.resize(static_cast<std::size_t>(execution.count()));
    }
    template <Execution E, class F>
    void copy(const E& execution, F&& f) {
      for_each_piece(execution, fields_[0].blocks(), 1, [&](std::size_t b, std::size_t) {
        for (std::size_t i = 0; i < Band::volume; ++i) f(b, i);
      });
    }
    /// S(phi) grad phi by centred differences, of fourth order for schemes above the first.
    template <Execution E>
    void find_velocity(const Band& band, const E& execution) {
      for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
        Patch<T, D>& patch = patches_[worker];
        patch.read_block(band, b, halo);
        for (std::size_t i = 0; i < Band::volume; ++i) {
          const T* at = patch.data() + patch.entry(i);
          Vec<D, T> slope;
          for (int d = 0; d < D; ++d) {
            const std::ptrdiff_t s = patch.stride()[d];
            const T near = T(0.5) * (at[s] - at[-s]);
            slope[d] = Scheme::order == 1 ? near : T(4) / T(3) * near - (at[2 * s] - at[-2 * s]) / T(12);
          }
          const T length = std::sqrt(at[0] * at[0] + dot(slope, slope));
          const T factor =
              length > T(0) && band.in_band(at[0]) ? at[0] / (length * static_cast<T>(band.spacing())) : T(0);
          for (int d = 0; d < D; ++d) velocity_[d][b * Band::volume + i] = factor * slope[d];
        }
      });
    }
    template <Execution E>
    void iterate(const Band& band, const E& execution) {
      int iterations = params_.iterations;
      if (iterations == 0) {
        const double width = static_cast<double>(band.half_width()) / band.spacing();
        iterations = static_cast<int>(std::ceil(2.0 * width / params_.cfl));
      }
      for (int k = 0; k < iterations; ++k) {
        if constexpr (Scheme::order == 1) {
          stage(0, T(1), 1, execution);
          std::swap(fields_[0], fields_[1]);
        } else {
          stage(0, T(1), 1, execution);
          stage(1, T(1) / T(4), 2, execution);
          stage(2, T(2) / T(3), 0, execution);
        }
      }
    }
    /// Field `to` := (1 - weight) field 0 + weight (from - dtau velocity . grad from).
    template <Execution E>
    void stage(std::size_t from, T weight, std::size_t to, const E& execution) {
      for_each_piece_by_worker(execution, fields_[0].blocks(), 1, [&](std::size_t w, std::size_t b, std::size_t) {
        Index<D> first = fields_[from].block_origin(b);
        for (int d = 0; d < D; ++d) first[d] -= halo;
        field_patches_[w].read(fields_[from], first, Index<D>::constant(Band::extent + 2 * halo));
        stage_of_block(field_patches_[w], b, fields_[0].block(b).data(), weight, fields_[to].block(b).data());
      });
    }
    bool at_rest(std::size_t row) const {
      for (const auto& column : velocity_) {
        if (std::any_of(column.data() + row, column.data() + row + lanes, [](T u) { return u != T(0); })) return false;
      }
      return true;
    }
    void stage_of_block(const FieldPatch<T, D>& patch, std::size_t b, const T* base, T weight, T* to) const {
      const Lanes step(static_cast<T>(-params_.cfl));
      for (std::size_t i = 0; i < Band::volume; i += lanes) {
        std::ptrdiff_t entry = 0;
        std::size_t rest = i;
        for (int d = 0; d < D; ++d, rest /= Band::extent) {
          entry += (halo + static_cast<std::ptrdiff_t>(rest % Band::extent)) * patch.stride()[d];
        }
        const T* at = patch.data(0) + entry;
        if (at_rest(b * Band::volume + i)) {
          std::copy_n(at, lanes, to + i);
          continue;
        }
        Lanes sum(T(0));
        for (int d = 0; d < D; ++d) {
          const T* velocity = velocity_[d].data() + b * Band::volume + i;
          alignas(64) T from_left[lanes];
          for (std::size_t l = 0; l < lanes; ++l) from_left[l] = velocity[l] > T(0) ? T(1) : T(0);
          const auto differences = detail::row_differences<Scheme, lanes>(at, patch.stride()[d]);
          sum = fma(Lanes::load_aligned(velocity), differences.upwind(Lanes::load_aligned(from_left)), sum);
        }
        const Lanes next = fma(step, sum, Lanes::load(at));
        (Lanes(T(1) - weight) * Lanes::load(base + i) + Lanes(weight) * next).store(to + i);
      }
    }

    Params params_;
    std::array<AlignedVector<T>, D> velocity_;
    std::vector<Scalars> fields_;
    std::vector<Patch<T, D>> patches_;
    std::vector<FieldPatch<T, D>> field_patches_;
  };
};

}  // namespace cambium
