// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <cambium/core/lattice.hpp>
#include <cambium/particles/validation.hpp>

namespace cambium {

/// Equal boxes (cells) that tile a domain, numbered with axis 0 fastest.
template <int D>
class CellGrid {
 public:
  CellGrid() = default;

  /// The fewest whole cells per axis that are at most `size` long: ceil(extent / size) of them.
  /// \throws ValueError if `size` is not positive and finite; LatticeError if the box is empty or the cells too many
  CellGrid(const Domain<D>& domain, double size) : domain_(domain) {
    require_extent(domain);
    if (!(size > 0.0) || !std::isfinite(size)) {
      throw ValueError(detail::message("cell size is ", size, ": it must be a positive, finite length"));
    }
    Vec<D> cells;
    // An extent of a whole number of sizes must not gain a cell by round-off.
    for (int d = 0; d < D; ++d) cells[d] = std::max(1.0, std::ceil(domain.box.extent()[d] / size * (1.0 - 1e-12)));
    set(cells);
  }

  /// `cells[d]` cells along axis d. \throws LatticeError if the box is empty or the cells are too many or fewer than
  /// one
  CellGrid(const Domain<D>& domain, const Index<D>& cells) : domain_(domain) {
    require_extent(domain);
    Vec<D> counts;
    for (int d = 0; d < D; ++d) counts[d] = static_cast<double>(cells[d]);
    set(counts);
  }

  /// The cells between the nodes of a lattice.
  static CellGrid cells_of(const Lattice<D>& lattice) { return from_lattice(lattice, 0); }
  /// One cell for each row of cells along axis 0 of a lattice: a cheaper order that keeps rows together.
  static CellGrid rows_of(const Lattice<D>& lattice) { return from_lattice(lattice, 1); }

  const Domain<D>& domain() const { return domain_; }
  /// Number of cells along each axis.
  const Index<D>& cells() const { return cells_; }
  /// Number of cells.
  std::size_t size() const { return static_cast<std::size_t>(product(cells_)); }
  /// Edge lengths of a cell.
  const Vec<D>& edge() const { return edge_; }

  /// Cell coordinate along axis d of a coordinate, without wrapping or bounds: a non-decreasing function of x.
  double coordinate(int d, double x) const { return std::floor((x - domain_.box.lo[d]) * inverse_edge_[d]); }

  /// Number of the cell that holds x; x may lie in any period. A point on the upper face of a bounded axis belongs to
  /// the last cell. x must be finite and inside a bounded box (see require_position).
  template <class T>
  std::size_t number(const Vec<D, T>& x) const {
    std::ptrdiff_t n = 0;
    for (int d = D - 1; d >= 0; --d) {
      const double lo = domain_.box.lo[d];
      const double hi = domain_.box.hi[d];
      double at = static_cast<double>(x[d]);
      if (domain_.periodic[d] && (at < lo || at >= hi)) at = domain_.wrap(d, at);
      n = n * cells_[d] + std::min(static_cast<std::ptrdiff_t>((at - lo) * inverse_edge_[d]), cells_[d] - 1);
    }
    return static_cast<std::size_t>(n);
  }

  friend bool operator==(const CellGrid&, const CellGrid&) = default;

 private:
  static CellGrid from_lattice(const Lattice<D>& lattice, int first_axis) {
    Index<D> cells = Index<D>::constant(1);
    for (int d = first_axis; d < D; ++d) cells[d] = lattice.nodes()[d] - (lattice.periodic(d) ? 0 : 1);
    return CellGrid(lattice.domain(), cells);
  }

  void set(const Vec<D>& cells) {
    constexpr double most = std::numeric_limits<std::uint32_t>::max();
    if (!(product(cells) < most)) {
      throw LatticeError(
          detail::message(cells, " cells are more than the ", most, " that can be numbered: choose larger cells"));
    }
    for (int d = 0; d < D; ++d) {
      if (cells[d] < 1.0) {
        throw LatticeError(detail::message(cells[d], " cells along axis ", d, ": there must be at least one"));
      }
      cells_[d] = static_cast<std::ptrdiff_t>(cells[d]);
      edge_[d] = domain_.box.extent()[d] / cells[d];
      inverse_edge_[d] = cells[d] / domain_.box.extent()[d];
    }
  }

  Domain<D> domain_;
  Index<D> cells_;
  Vec<D> edge_;
  Vec<D> inverse_edge_;
};

}  // namespace cambium
