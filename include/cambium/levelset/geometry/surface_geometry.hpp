// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/levelset/jet.hpp>

namespace cambium {

/// Geometry of the level line or surface of phi through a point.
template <class T, int D>
struct SurfaceGeometry {
  Vec<D, T> normal{};  ///< grad phi / |grad phi|: points to where phi grows, outwards
  T mean{};            ///< div n, the sum of the principal curvatures, in 1/length: circle 1/R, sphere 2/R
  T gaussian{};        ///< product of the principal curvatures, in 1/length^2: sphere 1/R^2; 0 in 2D
};

/// From the derivatives of phi, of any scaling:
///   n = g / |g|,  mean = (tr H - n . H n) / |g|,  Gaussian = g . adj(H) g / |g|^4
/// (Goldman, Curvature formulas for implicit curves and surfaces, Comput. Aided Geom. Design 22 (2005), eq. 3.1, 4.1).
/// All zero where the gradient vanishes: there is no normal.
/// \param jet  in spacings, as Interpolant gives it
template <class T, int D>
SurfaceGeometry<T, D> surface_geometry(const Jet<T, D>& jet, T spacing) {
  SurfaceGeometry<T, D> result;
  const T slope = norm(jet.gradient);
  if (!(slope > T(0))) return result;
  const Vec<D, T> n = jet.gradient / slope;
  T trace{};
  T along{};
  for (int d = 0; d < D; ++d) {
    trace += jet.hessian[d][d];
    along += n[d] * dot(jet.hessian[d], n);
  }
  result.normal = n;
  result.mean = (trace - along) / (slope * spacing);
  if constexpr (D == 3) {
    T sum{};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const int r = (i + 1) % 3, s = (i + 2) % 3, u = (j + 1) % 3, v = (j + 2) % 3;
        sum += n[i] * n[j] * (jet.hessian[r][u] * jet.hessian[s][v] - jet.hessian[r][v] * jet.hessian[s][u]);
      }
    }
    const T scale = slope * spacing;
    result.gaussian = sum / (scale * scale);
  }
  return result;
}

}  // namespace cambium
