// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include <cambium/simd/pack.hpp>

namespace cambium::detail {

using FarLanes = simd::Pack<double, simd::native_lanes<double>>;

/// A potential and its gradient at the targets of a vector.
template <int D>
struct FarSum {
  FarLanes potential = FarLanes(0.0);
  std::array<FarLanes, D> gradient = [] {
    std::array<FarLanes, D> zero;
    zero.fill(FarLanes(0.0));
    return zero;
  }();
};

/// Expansion of 4 pi (D = 3) or 2 pi (D = 2) times the potential of a cluster of sources about its centre, in units of
/// its radius. Both have: most_order; moments(p), the number of numbers that describe it up to order p; add(), which
/// adds lanes of sources to lanes of moments; finish(), which turns their sums into what prepare() takes;
/// prepared<Gradient>(p) and prepare<Gradient>(), coefficients in the order of their use; evaluate<Gradient>(), which
/// adds the potential at lanes of targets; and cost<Gradient>(p), that of a target in direct interactions.
template <int D>
class Expansion;

}  // namespace cambium::detail
