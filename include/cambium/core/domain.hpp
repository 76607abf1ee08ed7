// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include <cambium/core/box.hpp>

namespace cambium {

/// A box with one flag per axis that says whether it is periodic: where particles live.
template <int D>
struct Domain {
  Box<D> box;
  std::array<bool, D> periodic{};

  static constexpr Domain periodic_box(const Box<D>& box) {
    Domain domain{box, {}};
    domain.periodic.fill(true);
    return domain;
  }
  static constexpr Domain bounded_box(const Box<D>& box) { return {box, {}}; }

  /// Difference b - a along the shortest way: periodic axes take the nearest image.
  Vec<D> difference(const Vec<D>& a, const Vec<D>& b) const {
    Vec<D> result = b - a;
    for (int d = 0; d < D; ++d) {
      const double period = box.hi[d] - box.lo[d];
      if (periodic[d]) result[d] -= period * std::round(result[d] / period);
    }
    return result;
  }

  /// Coordinate along `axis` brought into [lo, hi), as if the axis were periodic.
  double wrap(int axis, double x) const {
    const double lo = box.lo[axis];
    const double period = box.hi[axis] - lo;
    x -= period * std::floor((x - lo) / period);
    // Round-off can leave the result an ulp below lo or on hi: both are lo.
    return x < lo || x >= box.hi[axis] ? lo : x;
  }

  /// Position brought into [lo, hi) along periodic axes, unchanged along the others.
  Vec<D> wrap(Vec<D> x) const {
    for (int d = 0; d < D; ++d) {
      if (periodic[d]) x[d] = wrap(d, x[d]);
    }
    return x;
  }

  friend constexpr bool operator==(const Domain&, const Domain&) = default;
};

}  // namespace cambium
