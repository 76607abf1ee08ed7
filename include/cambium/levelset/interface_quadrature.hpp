// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include <cambium/kernels/lambda.hpp>
#include <cambium/levelset/interface_integral.hpp>

namespace cambium {

/// Points and weights of a quadrature over an interface, on the curved elements of measures(): the integral of f over
/// the interface is sum_q |weighted_normal[q]| f(point[q]), with an error of O(h^4) for smooth ones.
template <int D>
struct InterfaceQuadrature {
  std::vector<Vec<D>> point;            ///< in spacings from the first node of the lattice; not wrapped
  std::vector<Vec<D>> weighted_normal;  ///< outward normal times weight, in lengths^(D - 1)

  std::size_t size() const { return point.size(); }
};

/// \tparam K  interpolating kernel of even support. \throws as measures()
template <class K = Lambda<4, 4>, class T, int D, Execution E = OpenMP>
InterfaceQuadrature<D> interface_quadrature(const NarrowBand<T, D>& band, const E& execution = {}) {
  const detail::InterfaceCells<K, T, D> cells(band, true, execution);
  std::vector<InterfaceQuadrature<D>> of_block(cells.cut_blocks());
  const double scale = std::pow(band.spacing(), D - 1);
  detail::InterfaceIntegral<K, T, D>(cells).for_each_element(execution, [&](const auto& place, const auto& nodes) {
    Vec<D> corner;
    for (int d = 0; d < D; ++d) corner[d] = static_cast<double>(place.node[d]);
    detail::CurvedElement<D>::for_each_point(nodes, [&](const Vec<D>& x, const Vec<D>& normal) {
      of_block[place.block].point.push_back(corner + x);
      of_block[place.block].weighted_normal.push_back(normal * scale);
    });
  });
  InterfaceQuadrature<D> all;
  for (const auto& block : of_block) {
    all.point.insert(all.point.end(), block.point.begin(), block.point.end());
    all.weighted_normal.insert(all.weighted_normal.end(), block.weighted_normal.begin(), block.weighted_normal.end());
  }
  return all;
}

}  // namespace cambium
