// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include <cambium/interface/cell_geometry.hpp>
#include <cambium/interface/finite_volumes.hpp>
#include <cambium/kernels/lambda.hpp>
#include <cambium/levelset/disjoint_sets.hpp>

namespace cambium::detail {

/// The cells around nodes that lie, wholly or in part, on one side of an interface: shares, balances, unknowns, and the
/// parts of the domain that no open face connects.
template <int D>
class CellDomain {
 public:
  using Geometry = CellGeometry<Lambda<4, 4>, D>;
  struct Unknown {
    std::size_t at;    ///< entry of the level
    std::size_t node;  ///< number of the node
  };
  static constexpr std::uint32_t none = static_cast<std::uint32_t>(-1);

  /// \param shift  s, in 1/length^2
  template <class B, Execution E>
  CellDomain(const NarrowBand<B, D>& band, Side side, double shift, const E& execution)
      : lattice(band.lattice()), cells(grid(lattice)) {
    Geometry geometry(band, side, cells.grid, execution);
    take_nodes(band, side, execution);
    take_cuts(geometry, shift);
    cells.settle(execution);
    number_unknowns();
    find_parts();
    faces = std::move(geometry.faces);
  }

  Lattice<D> lattice;
  FiniteVolumes<double, D> cells;
  std::vector<double> share;         ///< of the cell that is in the domain; entries are those of the level
  std::vector<WallPiece<D>> pieces;  ///< of the interface
  std::vector<CutFace<D>> faces;
  std::vector<Unknown> unknowns;
  std::vector<std::uint32_t> number;   ///< of the unknown at an entry, or `none`
  std::vector<std::uint32_t> part;     ///< that an unknown belongs to
  std::vector<double> volume_of_part;  ///< in spacings^D

 private:
  static LevelGrid<D> grid(const Lattice<D>& lattice) {
    std::array<Wall, D> walls{};
    walls.fill(Wall::neumann);
    return LevelGrid<D>(lattice.nodes(), lattice.periodic(), walls);
  }
  /// Shares and faces as the signs of nodes tell.
  template <class B, Execution E>
  void take_nodes(const NarrowBand<B, D>& band, Side side, const E& execution) {
    const auto& grid = cells.grid;
    share.assign(grid.size(), 0.0);
    cells.for_each_row(execution, [&](const Index<D>& first, std::size_t start) {
      Index<D> node = first;
      for (node[0] = 0; node[0] < grid.nodes[0]; ++node[0]) {
        const bool inside = band(node) < B(0);
        if (inside == (side == Side::inside)) share[start + static_cast<std::size_t>(node[0])] = at_walls(node, -1);
      }
    });
    cells.for_each_row(execution, [&](const Index<D>& first, std::size_t start) {
      Index<D> node = first;
      for (node[0] = 0; node[0] < grid.nodes[0]; ++node[0]) {
        const std::size_t at = start + static_cast<std::size_t>(node[0]);
        for (int d = 0; d < D; ++d) {
          Index<D> next = node + Index<D>::unit(d);
          if (next[d] == grid.nodes[d]) {
            if (!grid.periodic[d]) continue;
            next[d] = 0;
          }
          if (share[at] > 0.0 && share[grid.at(next)] > 0.0) cells.face[d][at] = at_walls(node, d);
        }
      }
    });
  }
  /// Those of the cells that the interface cuts.
  void take_cuts(const Geometry& geometry, double shift) {
    for (const auto& cut : geometry.volumes) share[cells.grid.at(cut.node)] = cut.volume;
    for (const auto& cut : geometry.faces) cells.face[cut.axis][cells.grid.at(cut.node)] = cut.open;
    const double square = shift * lattice.spacing() * lattice.spacing();
    for (std::size_t i = 0; i < share.size(); ++i) cells.mass[i] = square * share[i];
    pieces = geometry.pieces;
  }
  /// Part of a cell, or of its upper face along `axis`, that is within the walls.
  double at_walls(const Index<D>& node, int axis) const {
    double part_of_one = 1.0;
    for (int d = 0; d < D; ++d) {
      const bool on_wall = !lattice.periodic(d) && (node[d] == 0 || node[d] == lattice.nodes()[d] - 1);
      if (d != axis && on_wall) part_of_one *= 0.5;
    }
    return part_of_one;
  }
  void number_unknowns() {
    const auto& grid = cells.grid;
    number.assign(grid.size(), none);
    for (std::size_t i = 0; i < lattice.size(); ++i) {
      const Index<D> node = lattice.node(i);
      const std::size_t at = grid.at(node);
      if (!(cells.open(at) > 0.0)) {
        if (share[at] > 1e-9) refuse_closed(node);
        share[at] = cells.mass[at] = cells.inverse[at] = 0.0;
        continue;
      }
      number[at] = static_cast<std::uint32_t>(unknowns.size());
      unknowns.push_back({at, i});
    }
    std::erase_if(pieces, [&](const auto& piece) { return number[grid.at(piece.node)] == none; });
    if (unknowns.empty()) {
      throw InterfaceError(
          "the side of the interface on which an equation is to be solved has no cell: the shape is "
          "smaller than a spacing; refine the lattice or leave the equation out");
    }
  }
  [[noreturn]] static void refuse_closed(const Index<D>& node) {
    throw InterfaceError(message("the interface encloses a part of the cell of node ", node,
                                 " that no face connects to another: the domain is smaller than a spacing "
                                 "there; refine the lattice"));
  }
  void find_parts() {
    DisjointSets sets(unknowns.size());
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      for (int d = 0; d < D; ++d) {
        if (!(cells.face[d][unknowns[k].at] > 0.0)) continue;
        const Index<D> node = lattice.node(unknowns[k].node);
        sets.join(k, number[cells.grid.at(lattice.periodic(d) && node[d] == lattice.nodes()[d] - 1
                                              ? node - Index<D>::unit(d, node[d])
                                              : node + Index<D>::unit(d))]);
      }
    }
    part.resize(unknowns.size());
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      const std::size_t root = sets.find(k);
      if (root == k) volume_of_part.push_back(0.0);
      part[k] = root == k ? static_cast<std::uint32_t>(volume_of_part.size() - 1) : part[root];
      volume_of_part[part[k]] += share[unknowns[k].at];
    }
  }
};

}  // namespace cambium::detail
