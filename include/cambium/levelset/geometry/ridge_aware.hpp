// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include <cambium/levelset/geometry/difference_geometry.hpp>

namespace cambium {

/// Normals and curvatures of the level set through each node where phi may have ridges: where two fronts come within a
/// few spacings of each other, the centred gradient of a node between them is the average of two opposite ones.
///
/// Candidates for the derivatives at a node are the centred three-point stencils and, for each of the 2^D orthants, the
/// three-point stencils one-sided into it. An orthant takes one side along every axis, so that all components come from
/// the same front (sides chosen axis by axis mirror the normal of a slanted ridge). Linear weights are 2/3 for the
/// centred one and 1/3 shared by the orthants, which on smooth phi make the fourth-order gradient. Each is divided by
/// (epsilon + smoothness)^2, smoothness being the sum of the squares of the second differences that the stencil sees
/// (Jiang & Shu 1996). Candidates whose gradient is off that of the smoothest by more than half its length see the
/// other front and are left out: a node exactly half-way takes one side, not the average.
///
/// Away from ridges: order 4 for the gradient and 2 for curvatures. At ridges: 2 for the gradient, 1 for curvatures, if
/// the front that is chosen is alone within two nodes on its own side.
struct RidgeAware {
  struct Params {
    /// Square of the second difference, relative to the slope, that counts as none.
    double epsilon = 1e-6;
  };
  static constexpr int reach = 2;
  template <class T, int D>
  using Method = detail::DifferenceGeometry<RidgeAware, T, D>;

  /// Derivatives in spacings. \param at  the node in an array of values with strides `stride`
  template <class T, int D>
  static Jet<T, D> jet(const Params& params, const T* at, const Index<D>& stride) {
    constexpr int orthants = 1 << D;
    const Differences<T, D> differences(at, stride);
    std::array<Jet<T, D>, orthants + 1> candidate;
    std::array<T, orthants + 1> smoothness;
    int best = 0;
    for (int k = 0; k <= orthants; ++k) {
      candidate[k] = k == 0 ? differences.centred(smoothness[0]) : differences.one_sided(k - 1, smoothness[k]);
      if (smoothness[k] < smoothness[best]) best = k;
    }
    const Vec<D, T>& gradient = candidate[best].gradient;
    const T slope = dot(gradient, gradient);
    const T epsilon = static_cast<T>(params.epsilon) * slope;
    Jet<T, D> sum;
    T total{};
    for (int k = 0; k <= orthants; ++k) {
      const Vec<D, T> off = candidate[k].gradient - gradient;
      if (k != best && !(dot(off, off) < T(0.25) * slope)) continue;
      const T linear = k == 0 ? T(2) / T(3) : T(1) / T(3 * orthants);
      const T roughness = T(1) + (smoothness[k] - smoothness[best]) / (epsilon + smoothness[best]);
      const T weight = linear / (roughness * roughness);
      total += weight;
      sum.gradient += weight * candidate[k].gradient;
      for (int d = 0; d < D; ++d) sum.hessian[d] += weight * candidate[k].hessian[d];
    }
    if (!(slope > T(0))) return {*at, {}, {}};
    sum.value = *at;
    sum.gradient /= total;
    for (int d = 0; d < D; ++d) sum.hessian[d] /= total;
    return sum;
  }

 private:
  /// Differences between a node and those around it: side 0 is before, side 1 behind.
  template <class T, int D>
  struct Differences {
    T first[D][2];        ///< over the one-sided three-point stencils
    T second[D][3];       ///< before, behind, centred
    T mixed[D][D][2][2];  ///< over one cell: mixed[e][d], e < d
    T centred_first[D];

    Differences(const T* at, const Index<D>& stride) {
      for (int d = 0; d < D; ++d) {
        const std::ptrdiff_t step = stride[d];
        for (int side = 0; side < 2; ++side) {
          const std::ptrdiff_t to = side == 0 ? -step : step;
          const T sign = side == 0 ? T(-1) : T(1);
          second[d][side] = (at[2 * to] - at[to]) - (at[to] - *at);
          first[d][side] = sign * ((at[to] - *at) - T(0.5) * second[d][side]);
          for (int e = 0; e < d; ++e) {
            for (int other = 0; other < 2; ++other) {
              const std::ptrdiff_t across = other == 0 ? -stride[e] : stride[e];
              const T cell = (at[to + across] - at[to]) - (at[across] - *at);
              mixed[e][d][other][side] = side == other ? cell : -cell;
            }
          }
        }
        second[d][2] = (at[step] - *at) - (*at - at[-step]);
        centred_first[d] = T(0.5) * (at[step] - at[-step]);
      }
    }
    Jet<T, D> centred(T& smoothness) const {
      Jet<T, D> result;
      smoothness = T(0);
      for (int d = 0; d < D; ++d) {
        result.gradient[d] = centred_first[d];
        result.hessian[d][d] = second[d][2];
        smoothness += second[d][2] * second[d][2];
        for (int e = 0; e < d; ++e) {
          T sum{};
          for (int side = 0; side < 4; ++side) {
            const T value = mixed[e][d][side % 2][side / 2];
            sum += value;
            smoothness += T(0.25) * value * value;
          }
          result.hessian[d][e] = result.hessian[e][d] = T(0.25) * sum;
        }
      }
      return result;
    }
    /// \param orthant  bit d tells the side along axis d
    Jet<T, D> one_sided(int orthant, T& smoothness) const {
      Jet<T, D> result;
      smoothness = T(0);
      for (int d = 0; d < D; ++d) {
        const int side = orthant >> d & 1;
        result.gradient[d] = first[d][side];
        result.hessian[d][d] = second[d][side];
        smoothness += second[d][side] * second[d][side];
        for (int e = 0; e < d; ++e) {
          const T value = mixed[e][d][orthant >> e & 1][side];
          result.hessian[d][e] = result.hessian[e][d] = value;
          smoothness += value * value;
        }
      }
      return result;
    }
  };
};

}  // namespace cambium
