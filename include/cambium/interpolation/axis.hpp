// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <cambium/core/error.hpp>
#include <cambium/core/lattice.hpp>
#include <cambium/kernels/taps.hpp>

namespace cambium::detail {

/// Stencil of one particle along one axis: the cell it lies in and its offset from the middle of the stencil.
template <class T>
struct AxisOffset {
  std::ptrdiff_t cell;
  T g;
};

/// Number of cells that particles can lie in along an axis: one per node if periodic or if the kernel is centred on
/// nodes (odd support), one per gap between nodes otherwise.
template <class K, int D>
std::ptrdiff_t cells_along(const Lattice<D>& lattice, int axis) {
  return lattice.nodes()[axis] - (lattice.periodic(axis) || K::support % 2 == 1 ? 0 : 1);
}

/// Box of cells that one sweep covers, in cells of the lattice.
template <int D>
struct CellBox {
  Index<D> first;
  Index<D> count;
};

/// Finds the stencil of kernel K along one axis, for one particle or for a simd::Pack of them.
///
/// Periodic axes wrap. Round-off at a cell's face may put a particle into the neighbouring cell with an offset just
/// beyond +-1/2, where both cells' weights agree; it never leaves the range of cells.
template <class K, class T>
class AxisLocator {
 public:
  AxisLocator() = default;
  template <int D>
  AxisLocator(const Lattice<D>& lattice, int axis)
      : lo_(static_cast<T>(lattice.box().lo[axis])),
        inverse_spacing_(static_cast<T>(1.0 / lattice.spacing())),
        last_(static_cast<T>(cells_along<K>(lattice, axis) - 1)),
        period_(static_cast<T>(lattice.periodic(axis) ? lattice.nodes()[axis] : 0)),
        inverse_period_(static_cast<T>(lattice.periodic(axis) ? 1.0 / static_cast<double>(lattice.nodes()[axis]) : 0)) {
  }

  /// Position in spacings from the first node plus the kernel's shift, wrapped on periodic axes.
  template <class V>
  [[gnu::always_inline]] V reduce(const V& x) const {
    using std::floor;
    const V u = (x - V(lo_)) * V(inverse_spacing_) + V(static_cast<T>(Taps<K>::shift));
    return u - V(period_) * floor(u * V(inverse_period_));
  }
  /// Cell of a reduced position.
  template <class V>
  [[gnu::always_inline]] V cell(const V& reduced) const {
    using std::floor;
    using std::max;
    using std::min;
    return max(min(floor(reduced), V(last_)), V(T(0)));
  }

  AxisOffset<T> operator()(T x) const {
    const T u = reduce(x);
    const T c = cell(u);
    return {static_cast<std::ptrdiff_t>(c), u - c - T(0.5)};
  }

 private:
  T lo_{};
  T inverse_spacing_{};
  T last_{};
  T period_{};
  T inverse_period_{};
};

/// Weight of boundary node `j` in the extrapolation of degree `degree` to the node `outside` < 0, nodes 0, ..., degree
/// being given: the Lagrange polynomial prod_{i != j} (outside - i) / (j - i).
constexpr double extrapolation_weight(int outside, int j, int degree) {
  double weight = 1.0;
  for (int i = 0; i <= degree; ++i) {
    if (i != j) weight *= static_cast<double>(outside - i) / (j - i);
  }
  return weight;
}

/// \throws LatticeError if the lattice has fewer nodes along an axis than the kernel has under it
template <class K, int D>
void require_room_for_kernel(const Lattice<D>& lattice) {
  for (int d = 0; d < D; ++d) {
    const int needed = K::support > K::moments + 1 ? K::support : K::moments + 1;
    if (lattice.nodes()[d] < needed) {
      throw LatticeError(detail::message("lattice has ", lattice.nodes()[d], " nodes along axis ", d,
                                         " but the kernel needs at least ", needed,
                                         ": refine the lattice or choose a narrower kernel"));
    }
  }
}

}  // namespace cambium::detail
