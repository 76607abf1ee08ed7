// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include <cambium/kernels/m4_prime.hpp>
#include <cambium/levelset/jet.hpp>
#include <cambium/levelset/narrow_band.hpp>

namespace cambium::detail {

/// Value of a field of a band at a point, interpolated by M4'.
template <int D>
double value_at(const Field<double, D, Sparse>& field, const NarrowBand<double, D>& band, const Vec<D>& x) {
  constexpr std::ptrdiff_t support = 4;
  std::array<double, static_cast<std::size_t>(D == 2 ? 16 : 64) + 16> nodes{};
  Index<D> first, stride;
  Vec<D> u;
  for (int d = 0; d < D; ++d) {
    const double place = (x[d] - band.lattice().box().lo[d]) / band.spacing();
    first[d] = static_cast<std::ptrdiff_t>(std::floor(place)) - support / 2 + 1;
    u[d] = place - static_cast<double>(first[d]);
    stride[d] = d == 0 ? 1 : stride[d - 1] * support;
  }
  for (std::ptrdiff_t k = 0; k < (D == 2 ? 16 : 64); ++k) {
    Index<D> node = first;
    for (int d = 0; d < D; ++d) node[d] += k / stride[d] % support;
    nodes[static_cast<std::size_t>(k)] = field(band.inside(node));
  }
  return Interpolant<M4Prime, double, D>::value(nodes.data(), stride, u);
}

}  // namespace cambium::detail
