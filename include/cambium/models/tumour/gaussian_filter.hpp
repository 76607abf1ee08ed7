// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include <cambium/levelset/field_patch.hpp>
#include <cambium/models/tumour/policy.hpp>

namespace cambium {

/// The speed of the interface as it is.
struct NoFilter {
  using Kind = tumour_kind::Filter;
  template <int D>
  class Method {
   public:
    explicit Method(const Lattice<D>&) {}
    void operator()(const NarrowBand<double, D>&, Field<double, D, Sparse>&, const OpenMP&) {}
  };
};

/// The source's filter of the speed (11.68): along each axis in turn the mean of 6 M + 1 nodes weighted by a Gaussian
/// of standard deviation M h. Nodes without a speed have no part in it. Waves of wave number k along the interface keep
/// exp(-k^2 s^2 / 2), s^2 being the variance of the weights (by up to 3% below that of the Gaussian: they end at 3 M),
/// and waves cos(l theta) of a circle of radius r keep 1 - l^2 s^2 / (2 r^2) + O(s^4): resolved ones lose, too, and the
/// answer depends on h M. A comparator.
template <int M>
struct GaussianFilter {
  static_assert(M >= 1, "cambium::GaussianFilter: M must be at least 1");
  using Kind = tumour_kind::Filter;

  template <int D>
  class Method {
   public:
    explicit Method(const Lattice<D>& lattice) : next_(lattice) {
      for (int i = -reach; i <= reach; ++i) {
        weight_[static_cast<std::size_t>(i + reach)] = std::exp(-0.5 * i * i / (static_cast<double>(M) * M));
      }
    }
    /// Filters the speeds of the nodes that have one (the others have NaN).
    void operator()(const NarrowBand<double, D>& band, Field<double, D, Sparse>& speed, const OpenMP& execution) {
      take_blocks(next_, band);
      patches_.resize(static_cast<std::size_t>(execution.count()));
      for (int d = 0; d < D; ++d) {
        for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
          filter_block(band, speed, b, d, patches_[worker]);
        });
        std::swap(speed, next_);
      }
    }

   private:
    static constexpr int reach = 3 * M;

    void filter_block(const NarrowBand<double, D>& band, const Field<double, D, Sparse>& speed, std::size_t b, int d,
                      FieldPatch<double, D>& patch) {
      const Index<D> first = band.values().block_origin(b) - Index<D>::unit(d, reach);
      const Index<D> edge = Index<D>::constant(band.extent) + Index<D>::unit(d, 2 * reach);
      patch.read(speed, first, edge);
      for (std::size_t i = 0; i < band.volume; ++i) {
        std::ptrdiff_t at = 0;
        std::size_t rest = i;
        for (int e = 0; e < D; ++e, rest /= static_cast<std::size_t>(band.extent)) {
          at += static_cast<std::ptrdiff_t>(rest % static_cast<std::size_t>(band.extent)) * patch.stride()[e];
        }
        double sum = 0.0, weights = 0.0;
        for (std::size_t k = 0; k < weight_.size(); ++k) {
          const double value = patch.data(0)[at + static_cast<std::ptrdiff_t>(k) * patch.stride()[d]];
          if (std::isnan(value)) continue;
          sum += weight_[k] * value;
          weights += weight_[k];
        }
        const double here = speed.block(b)[i];
        next_.block(b)[i] = std::isnan(here) ? here : sum / weights;
      }
    }

    std::array<double, static_cast<std::size_t>(2 * reach + 1)> weight_{};
    Field<double, D, Sparse> next_;
    std::vector<FieldPatch<double, D>> patches_;
  };
};

}  // namespace cambium
