// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <cambium/core/domain.hpp>
#include <cambium/core/error.hpp>

namespace cambium {

/// Node-centred uniform lattice over a box, periodic or bounded along each axis.
///
/// A periodic axis of length L = n h has the n nodes lo, lo + h, ..., hi - h. A bounded axis has the n + 1 nodes
/// lo, ..., hi, so that both faces carry nodes. Nodes are numbered with axis 0 fastest.
template <int D>
class Lattice {
 public:
  static_assert(D >= 1 && D <= 3, "cambium::Lattice: the dimension must be 1, 2 or 3");
  static constexpr int dimension = D;

  /// \param spacing   node distance h, the same along every axis (length units of the box)
  /// \param periodic  one flag per axis
  /// \throws LatticeError if h is not positive and finite, the box is empty or not finite, an extent is not a whole
  ///         number of spacings (to 1e-9 of a spacing, relative to the number of cells), or the nodes are too many to
  ///         be numbered
  Lattice(const Box<D>& box, double spacing, const std::array<bool, D>& periodic)
      : domain_{box, periodic}, spacing_(spacing) {
    if (!(spacing > 0.0) || !std::isfinite(spacing)) {
      throw LatticeError(detail::message("lattice spacing is ", spacing, ": it must be a positive, finite length"));
    }
    for (int d = 0; d < D; ++d) nodes_[d] = count_cells(d) + (periodic[d] ? 0 : 1);
    double nodes = 1.0;
    for (int d = 0; d < D; ++d) nodes *= static_cast<double>(nodes_[d]);
    if (nodes > most_nodes) {
      throw LatticeError(
          detail::message("lattice of ", nodes_, " nodes is too large to be numbered: ", larger_spacing));
    }
  }

  /// Lattice with `cells` cells along axis 0, periodic along every axis.
  static Lattice periodic_box(const Box<D>& box, std::ptrdiff_t cells) { return from_cells(box, cells, true); }
  /// Lattice with `cells` cells along axis 0, bounded along every axis (cells + 1 nodes).
  static Lattice bounded_box(const Box<D>& box, std::ptrdiff_t cells) { return from_cells(box, cells, false); }

  const Box<D>& box() const { return domain_.box; }
  const Domain<D>& domain() const { return domain_; }
  double spacing() const { return spacing_; }
  /// Volume h^D that one node stands for.
  double cell_volume() const { return std::pow(spacing_, D); }
  bool periodic(int axis) const { return domain_.periodic[axis]; }
  const std::array<bool, D>& periodic() const { return domain_.periodic; }

  /// Number of nodes along each axis.
  const Index<D>& nodes() const { return nodes_; }
  /// Number of nodes.
  std::size_t size() const { return static_cast<std::size_t>(product(nodes_)); }

  /// lo + i h along each axis; the last node of a bounded axis is on the face to the last bit, never a rounding
  /// outside.
  Vec<D> position(const Index<D>& node) const {
    Vec<D> x;
    for (int d = 0; d < D; ++d) {
      const bool on_face = !domain_.periodic[d] && node[d] == nodes_[d] - 1;
      x[d] = on_face ? domain_.box.hi[d] : domain_.box.lo[d] + static_cast<double>(node[d]) * spacing_;
    }
    return x;
  }

  /// Number of a node, axis 0 fastest.
  std::size_t number(const Index<D>& node) const {
    std::ptrdiff_t n = node[D - 1];
    for (int d = D - 2; d >= 0; --d) n = n * nodes_[d] + node[d];
    return static_cast<std::size_t>(n);
  }
  /// Node with a given number; the inverse of number().
  Index<D> node(std::size_t number) const {
    Index<D> result;
    auto rest = static_cast<std::ptrdiff_t>(number);
    for (int d = 0; d < D; ++d) {
      result[d] = rest % nodes_[d];
      rest /= nodes_[d];
    }
    return result;
  }
  /// True if `node` is a node of the lattice (no periodic wrapping).
  bool contains(const Index<D>& node) const {
    for (int d = 0; d < D; ++d) {
      if (node[d] < 0 || node[d] >= nodes_[d]) return false;
    }
    return true;
  }
  /// Node index along `axis` brought into the lattice if the axis is periodic, unchanged otherwise.
  std::ptrdiff_t wrap(int axis, std::ptrdiff_t i) const {
    if (!domain_.periodic[axis]) return i;
    const std::ptrdiff_t n = nodes_[axis];
    i %= n;
    return i < 0 ? i + n : i;
  }

  friend bool operator==(const Lattice&, const Lattice&) = default;

 private:
  /// 2^53: whole numbers up to it are exact in double precision.
  static constexpr double most_nodes = 9007199254740992.0;
  static constexpr const char* larger_spacing = "choose a larger spacing";

  static Lattice from_cells(const Box<D>& box, std::ptrdiff_t cells, bool periodic) {
    if (cells < 1) {
      throw LatticeError(detail::message("lattice with ", cells, " cells along axis 0: it needs at least one"));
    }
    std::array<bool, D> flags{};
    flags.fill(periodic);
    return Lattice(box, (box.hi[0] - box.lo[0]) / static_cast<double>(cells), flags);
  }

  std::ptrdiff_t count_cells(int d) const {
    const double length = domain_.box.hi[d] - domain_.box.lo[d];
    if (!(length > 0.0) || !std::isfinite(length)) {
      throw LatticeError(detail::message("box has extent ", length, " along axis ", d, " (from ", domain_.box.lo[d],
                                         " to ", domain_.box.hi[d], "): it must be positive and finite"));
    }
    const double cells = std::round(length / spacing_);
    if (cells > most_nodes) {
      throw LatticeError(detail::message("lattice of ", cells, " nodes along axis ", d,
                                         " is too large to be numbered: ", larger_spacing));
    }
    if (cells < 1.0 || std::abs(length / spacing_ - cells) > 1e-9 * cells) {
      throw LatticeError(detail::message(domain_.periodic[d] ? "period " : "extent ", length, " along axis ", d, " is ",
                                         length / spacing_, " spacings of ", spacing_,
                                         ": choose a spacing that divides it a whole number of times"));
    }
    return static_cast<std::ptrdiff_t>(cells);
  }

  Domain<D> domain_;
  double spacing_;
  Index<D> nodes_{};
};

}  // namespace cambium
