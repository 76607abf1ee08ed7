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

/// Finds the stencil of kernel K along one axis.
///
/// Periodic axes wrap; `cell` is in [0, nodes). On bounded axes a particle on the upper face belongs to the last cell.
template <class K, class T>
class AxisLocator {
 public:
  template <int D>
  AxisLocator(const Lattice<D>& lattice, int axis)
      : lo_(static_cast<T>(lattice.box().lo[axis])),
        inverse_spacing_(static_cast<T>(1.0 / lattice.spacing())),
        nodes_(static_cast<T>(lattice.nodes()[axis])),
        last_(static_cast<T>(lattice.nodes()[axis] - (lattice.periodic(axis) || K::support % 2 == 1 ? 1 : 2))),
        period_(lattice.periodic(axis) ? nodes_ : T(0)) {}

  /// Position in spacings from the first node, wrapped into [0, nodes] on periodic axes, plus the kernel's shift.
  T reduce(T x) const {
    T u = (x - lo_) * inverse_spacing_ + static_cast<T>(Taps<K>::shift);
    return u - period_ * std::floor(u / nodes_);
  }
  /// Cell of a reduced position.
  T cell(T reduced) const { return std::min(std::floor(reduced), last_); }

  AxisOffset<T> operator()(T x) const {
    const T u = reduce(x);
    const T c = cell(u);
    return {static_cast<std::ptrdiff_t>(c), u - c - T(0.5)};
  }

 private:
  T lo_;
  T inverse_spacing_;
  T nodes_;
  T last_;
  T period_;
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

/// \throws PositionError unless x is finite and, along bounded axes, inside the box
template <int D, class T>
void require_inside(const Domain<D>& domain, const Vec<D, T>& x, std::size_t particle) {
  for (int d = 0; d < D; ++d) {
    if (!std::isfinite(x[d])) {
      throw PositionError(detail::message("particle ", particle, " has position ", x, ": component ", d,
                                          " is not finite; check the velocity and the time step"));
    }
    if (!domain.periodic[d] && !(x[d] >= domain.box.lo[d] && x[d] <= domain.box.hi[d])) {
      throw PositionError(detail::message("particle ", particle, " at ", x, " is outside the bounded box ",
                                          domain.box.lo, " to ", domain.box.hi, " along axis ", d,
                                          ": enlarge the box or remove the particle"));
    }
  }
}

}  // namespace cambium::detail
