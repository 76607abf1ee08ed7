// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <cambium/interface/node_sides.hpp>
#include <cambium/interface/side.hpp>
#include <cambium/kernels/lambda.hpp>
#include <cambium/levelset/edge_root.hpp>
#include <cambium/levelset/patch.hpp>
#include <cambium/multigrid/level.hpp>

namespace cambium::detail {

/// What a node is to a problem on one side of an interface.
/// `between`: continued, but by lines that come from opposite sides of it.
enum NodeKind : std::uint8_t { beyond = 0, plain = 1, given = 2, cut = 3, continued = 4, between = 5 };

/// A node of the domain with a neighbour on the other side. leg[2 d + way]: distance of the interface along -e_d, +e_d
/// in spacings, in [0, 1]; `whole` if the neighbour is of the domain.
template <int D>
struct CutNode {
  static constexpr double whole = -1.0;
  Index<D> node;
  std::size_t at;
  std::array<double, 2 * static_cast<std::size_t>(D)> leg;
};

/// Nodes of a level on one side of an interface, and where the legs of their stencils cross it.
template <int D>
struct CutDomain {
  explicit CutDomain(const LevelGrid<D>& level_grid) : grid(level_grid) {}

  LevelGrid<D> grid;
  std::vector<std::uint8_t> kind;  ///< NodeKind of the entries of the level
  std::vector<CutNode<D>> nodes;   ///< sorted by their entries
  std::ptrdiff_t unknowns = 0;
  std::array<bool, D> touches{};  ///< true if the domain has nodes on a wall of this axis

  /// Neighbour of a node; periodic axes wrap, Neumann walls mirror.
  Index<D> neighbour(Index<D> node, std::size_t leg) const {
    const int d = static_cast<int>(leg / 2);
    std::ptrdiff_t& i = node[d];
    i += leg % 2 == 0 ? -1 : 1;
    const std::ptrdiff_t n = grid.nodes[d];
    if (i < 0) i = grid.periodic[d] ? n - 1 : 1;
    if (i >= n) i = grid.periodic[d] ? 0 : n - 2;
    return node;
  }
  /// True if the node at an entry is plain and a neighbour is beyond, or may be so across a face of the lattice.
  bool beside_beyond(std::size_t at) const {
    if (kind[at] != plain) return false;
    for (int d = 0; d < D; ++d) {
      const auto step = static_cast<std::size_t>(grid.stride[d]);
      if (kind[at - step] == beyond || kind[at + step] == beyond) return true;  // so is the layer around the lattice
    }
    return false;
  }
  bool in_domain(const Index<D>& node) const { return kind[grid.at(node)] != beyond; }
  /// The cut node at an entry that is one.
  const CutNode<D>& cut_node(std::size_t at) const { return *std::ranges::lower_bound(nodes, at, {}, &CutNode<D>::at); }
  /// Legs of a node, whole where it is not cut.
  double leg(const Index<D>& node, std::size_t k) const {
    const std::size_t at = grid.at(node);
    return kind[at] == cut ? cut_node(at).leg[k] : CutNode<D>::whole;
  }

  /// To be called when kinds are `beyond` or `plain`: finds given faces and counts.
  void find_given() {
    unknowns = 0;
    touches.fill(false);
    const std::ptrdiff_t end = grid.nodes[0] - 1;
    for_each_row<D>(Index<D>{}, grid.nodes - Index<D>::constant(1), [&](const Index<D>& first) {
      std::uint8_t* const row = kind.data() + grid.at(first);
      bool on_face = false;
      std::array<bool, D> faces{};
      for (int d = 1; d < D; ++d) {
        if (grid.periodic[d] || (first[d] != 0 && first[d] != grid.nodes[d] - 1)) continue;
        faces[static_cast<std::size_t>(d)] = true;
        on_face = on_face || grid.given_faces(d);
      }
      std::ptrdiff_t here = 0;
      for (std::ptrdiff_t i = 0; i <= end; ++i) here += row[i] != beyond;
      if (here == 0) return;
      for (std::size_t d = 1; d < D; ++d) touches[d] = touches[d] || faces[d];
      const bool ends = !grid.periodic[0] && (row[0] != beyond || row[end] != beyond);
      touches[0] = touches[0] || ends;
      for (std::ptrdiff_t i = 0; i <= end; ++i) {
        const bool face = on_face || (grid.given_faces(0) && (i == 0 || i == end));
        if (face && row[i] != beyond) {
          row[i] = given;
          --here;
        }
        if (!on_face && i == 0 && end > 0) i = end - 1;  // only the two ends may be faces
      }
      unknowns += here;
    });
  }
  void sort_cut_nodes() {
    std::ranges::sort(nodes, {}, &CutNode<D>::at);
    for (const auto& node : nodes) kind[node.at] = cut;
  }
};

/// Marks the nodes of one side of a level set.
template <class T, int D, Execution E>
void find_kinds(const NarrowBand<T, D>& band, Side side, CutDomain<D>& domain, const E& execution) {
  domain.kind.assign(domain.grid.size(), beyond);
  for_each_side_row(band, execution, [&](const Index<D>& row, std::ptrdiff_t count, const auto& inside) {
    std::uint8_t* const to = domain.kind.data() + domain.grid.at(row);
    for (std::ptrdiff_t i = 0; i < count; ++i) to[i] = inside(i) == (side == Side::inside) ? plain : beyond;
  });
}

/// Calls f(node, its number in the block) for nodes of a block that are plain and may have a neighbour beyond.
template <class T, int D, class F>
void each_beside(const NarrowBand<T, D>& band, std::size_t b, const CutDomain<D>& domain, F&& f) {
  constexpr std::ptrdiff_t extent = NarrowBand<T, D>::extent;
  const Index<D> origin = band.values().block_origin(b);
  Index<D> last;
  for (int d = 0; d < D; ++d) last[d] = std::min(origin[d] + extent, domain.grid.nodes[d]) - 1;
  for_each_row<D>(origin, last, [&](const Index<D>& row) {
    const std::size_t start = domain.grid.at(row);
    Index<D> node = row;
    for (; node[0] <= last[0]; ++node[0]) {
      const auto i = static_cast<std::size_t>(node[0] - row[0]);
      if (domain.beside_beyond(start + i)) f(node, Field<T, D, Sparse>::offset(node));
    }
  });
}

/// Finds the crossings of the legs with the zero set of the interpolant of kernel K along them.
template <class K, class T, int D, Execution E>
void find_crossings(const NarrowBand<T, D>& band, CutDomain<D>& domain, const E& execution) {
  std::vector<std::vector<CutNode<D>>> found(band.blocks());
  std::vector<Patch<T, D>> patches(static_cast<std::size_t>(execution.count()));
  for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
    Patch<T, D>& patch = patches[worker];
    bool read = false;
    each_beside(band, b, domain, [&](const Index<D>& node, std::size_t i) {
      if (!read) patch.read_block(band, b, K::support / 2);
      read = true;
      CutNode<D> candidate{node, domain.grid.at(node), {}};
      bool crossed = false;
      for (std::size_t k = 0; k < candidate.leg.size(); ++k) {
        const bool whole = domain.in_domain(domain.neighbour(node, k));
        const std::ptrdiff_t stride = patch.stride()[static_cast<int>(k / 2)];
        candidate.leg[k] = whole ? CutNode<D>::whole
                                 : EdgeRoot<K, T>::find(patch.data() + patch.entry(i), k % 2 == 0 ? -stride : stride);
        crossed = crossed || !whole;
      }
      if (crossed) found[b].push_back(candidate);
    });
  });
  domain.nodes.clear();
  for (const auto& nodes : found) domain.nodes.insert(domain.nodes.end(), nodes.begin(), nodes.end());
  domain.sort_cut_nodes();
}

/// Calls f(node) for nodes 2 i of a level whose neighbour, or whose neighbour's next, is across the interface: cut
/// nodes and the nodes before them. Some are called more than once.
template <int D, class F>
void each_coarse_candidate(const CutDomain<D>& fine, F&& f) {
  const auto odd = [](const Index<D>& node) {
    int count = 0;
    for (int d = 0; d < D; ++d) count += static_cast<int>(node[d] % 2);
    return count;
  };
  for (const auto& cut_node : fine.nodes) {
    const int odds = odd(cut_node.node);
    if (odds == 0) f(cut_node.node);
    if (odds != 1) continue;
    for (std::size_t k = 0; k < cut_node.leg.size(); ++k) {
      if (cut_node.leg[k] < 0.0) continue;
      const Index<D> before = fine.neighbour(cut_node.node, k ^ 1);
      if (odd(before) == 0) f(before);
    }
  }
}

/// The domain on nodes 2 i of a finer one: its legs are two of those, and end where the first of them is cut.
template <int D>
void coarsen(const CutDomain<D>& fine, CutDomain<D>& coarse) {
  const LevelGrid<D>& grid = coarse.grid;
  coarse.kind.assign(grid.size(), beyond);
  coarse.nodes.clear();
  Index<D> last = grid.nodes - Index<D>::constant(1);
  for (int d = 0; d < D; ++d) last[d] = std::min(last[d], (fine.grid.nodes[d] - 1) / 2);
  for_each_row<D>(Index<D>{}, last, [&](const Index<D>& row) {
    const std::uint8_t* const from = fine.kind.data() + fine.grid.at(row * std::ptrdiff_t{2});
    std::uint8_t* const to = coarse.kind.data() + grid.at(row);
    for (std::ptrdiff_t i = 0; i <= last[0]; ++i) to[i] = from[2 * i] == beyond ? beyond : plain;
  });
  coarse.find_given();
  each_coarse_candidate(fine, [&](const Index<D>& from) {
    Index<D> node;
    for (int d = 0; d < D; ++d) node[d] = from[d] / 2;
    const std::size_t at = grid.at(node);
    if (coarse.kind[at] != plain) return;
    CutNode<D> candidate{node, at, {}};
    bool crossed = false;
    for (std::size_t k = 0; k < candidate.leg.size(); ++k) {
      double length = fine.leg(from, k) * 0.5;
      if (length < 0.0) {
        const double second = fine.leg(fine.neighbour(from, k), k);
        length = second < 0.0 ? CutNode<D>::whole : 0.5 * (1.0 + second);
      }
      candidate.leg[k] = length;
      crossed = crossed || length >= 0.0;
    }
    if (!crossed) return;
    coarse.kind[at] = cut;  // so that it is taken once
    coarse.nodes.push_back(candidate);
  });
  coarse.sort_cut_nodes();
}

}  // namespace cambium::detail
