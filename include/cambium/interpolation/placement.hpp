// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <cambium/interpolation/row_order.hpp>

namespace cambium {

/// Positions of particles on a lattice, checked and put in the order of rows of cells once, for several P2M and M2P
/// with kernel K at the same positions.
///
///     cambium::Placement<cambium::M6, 3> placement(lattice, particles.positions());
///     interpolator.p2m(placement, particles[mass], density);
///     interpolator.m2p(velocity, placement, particles[u]);
///
/// It refers to the positions and must be updated when they change. Updating reuses its memory.
template <RemeshingKernel K, int D, class P = double>
class Placement {
 public:
  Placement() = default;
  /// \throws PositionError if a position is not finite or outside a bounded box, LatticeError if the lattice has fewer
  ///         nodes than the kernel needs
  template <class Q, Execution E = OpenMP>
  Placement(const Lattice<D>& lattice, Columns<D, Q> positions, const E& execution = {}) {
    update(lattice, positions, execution);
  }

  /// Places other particles, or the same after they moved. \throws as the constructor
  template <class Q, Execution E = OpenMP>
  void update(const Lattice<D>& lattice, Columns<D, Q> positions, const E& execution = {}) {
    const Columns<D, const P> x = positions;
    detail::require_room_for_kernel<K>(lattice);
    order_.template build<K>(lattice, x, execution);
    lattice_ = lattice;
    arrange(x, execution);
  }
  /// \throws LatticeError unless the particles were placed on this lattice
  void require_lattice(const Lattice<D>& lattice) const {
    if (lattice_ && *lattice_ == lattice) return;
    throw LatticeError(lattice_ ? "particles were placed on another lattice than the mesh: update the placement"
                                : "no particles were placed: update the placement before it is used");
  }

  /// Number of particles.
  std::size_t size() const { return size_; }
  /// True if the particles came in the order of rows, so that nothing was copied.
  bool sorted() const { return order_.sorted(); }

  const detail::RowOrder& order() const { return order_; }
  /// Positions in the order of rows, one array for each axis.
  const std::array<const P*, D>& positions() const { return ordered_; }

  /// Takes the order of rows that `build(order)` makes; for meshes with rows of their own.
  template <class F, Execution E>
  void update_by(Columns<D, const P> positions, F&& build, const E& execution) {
    build(order_);
    arrange(positions, execution);
  }

 private:
  template <Execution E>
  void arrange(Columns<D, const P> x, const E& execution) {
    size_ = x.size();
    for (int d = 0; d < D; ++d) {
      ordered_[d] = x.column(d).data();
      if (order_.sorted()) continue;
      order_.scatter(x.column(d), copies_[d], execution);
      ordered_[d] = copies_[d].data();
    }
  }

  std::optional<Lattice<D>> lattice_;
  detail::RowOrder order_;
  std::size_t size_ = 0;
  std::array<AlignedVector<P>, D> copies_;
  std::array<const P*, D> ordered_{};
};

}  // namespace cambium
