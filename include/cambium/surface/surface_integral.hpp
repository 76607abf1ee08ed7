// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include <cambium/levelset/interface_quadrature.hpp>
#include <cambium/parallel/compensated_sum.hpp>
#include <cambium/surface/point_reader.hpp>
#include <cambium/surface/surface_band.hpp>

namespace cambium {

/// Integrals over an interface of functions on its surface band, as weights of their values: error O(h^4), or that of
/// the interpolation to the interface.
template <class Stencil = SurfaceLaplacian<2>, int D = 3, class T = double>
class SurfaceIntegral {
 public:
  SurfaceIntegral() = default;
  /// See fit().
  template <class LevelSet>
  SurfaceIntegral(const LevelSet& level_set, const SurfaceBand<Stencil, D, T>& band) {
    fit(level_set, band);
  }

  /// Finds the weights. \param band  that of the level set. \throws as measures()
  template <class LevelSet, Execution E = OpenMP>
  void fit(const LevelSet& level_set, const SurfaceBand<Stencil, D, T>& band, const E& execution = {}) {
    const InterfaceQuadrature<D> quadrature = interface_quadrature(level_set.band(), execution);
    const auto& plan = band.plan();
    reader_.locate(
        plan, quadrature.size(), [&](std::size_t q) { return quadrature.point[q]; },
        [&](std::size_t q) { return quadrature.weighted_normal[q]; }, execution);
    weight_.assign(band.size(), 0.0);
    patch_.assign(plan.largest_patch, T(0));
    reader_.for_each_group(Serial{}, [&](std::size_t, std::size_t g, std::size_t begin, std::size_t end) {
      const auto& group = plan.groups[g];
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t q = reader_.order(i);
        reader_.stencil(plan, q).spread(static_cast<T>(norm(quadrature.weighted_normal[q])), patch_.data());
      }
      for (std::size_t e = group.first_entry; e < group.first_entry + group.entries; ++e) {
        weight_[static_cast<std::size_t>(plan.source[e])] += static_cast<double>(patch_[plan.entry[e]]);
        patch_[plan.entry[e]] = T(0);
      }
    });
  }

  /// Weights of the values; they add up to the area of the interface.
  std::span<const double> weights() const { return weight_; }
  /// The integral of an array of values, the same bits for any number of threads.
  double operator()(std::span<const T> values) const {
    require_size(values.size(), weight_.size(), "the array to integrate");
    CompensatedSum sum;
    for (std::size_t k = 0; k < weight_.size(); ++k) sum += weight_[k] * static_cast<double>(values[k]);
    return sum.value();
  }
  /// That of f(value), e.g. of squares for norms.
  template <class F>
  double operator()(std::span<const T> values, F&& f) const {
    require_size(values.size(), weight_.size(), "the array to integrate");
    CompensatedSum sum;
    for (std::size_t k = 0; k < weight_.size(); ++k) sum += weight_[k] * static_cast<double>(f(values[k]));
    return sum.value();
  }

 private:
  detail::PointReader<Stencil, T, D> reader_;
  std::vector<double> weight_;
  AlignedVector<T> patch_;
};

}  // namespace cambium
