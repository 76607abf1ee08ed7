// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/core/vec.hpp>

namespace cambium {

/// An axis-parallel box from corner `lo` to corner `hi`.
template <int D>
struct Box {
  Vec<D> lo;
  Vec<D> hi;

  /// The box [0, length]^D.
  static constexpr Box cube(double length = 1.0) { return {Vec<D>{}, Vec<D>::constant(length)}; }

  constexpr Vec<D> extent() const { return hi - lo; }
  constexpr Vec<D> centre() const { return (lo + hi) * 0.5; }
  constexpr double volume() const { return product(extent()); }

  /// Closed containment: faces belong to the box.
  constexpr bool contains(const Vec<D>& x) const {
    for (int d = 0; d < D; ++d) {
      if (!(x[d] >= lo[d] && x[d] <= hi[d])) return false;
    }
    return true;
  }

  friend constexpr bool operator==(const Box&, const Box&) = default;
};

}  // namespace cambium
