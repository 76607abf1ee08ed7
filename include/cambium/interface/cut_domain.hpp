// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <cambium/interface/side.hpp>
#include <cambium/kernels/lambda.hpp>
#include <cambium/levelset/edge_root.hpp>
#include <cambium/levelset/patch.hpp>
#include <cambium/multigrid/level.hpp>

namespace cambium::detail {

/// What a node is to a problem on one side of an interface.
enum NodeKind : std::uint8_t { beyond = 0, plain = 1, given = 2, cut = 3, continued = 4 };

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
    for_each_row<D>(Index<D>{}, grid.nodes - Index<D>::constant(1), [&](const Index<D>& first) {
      Index<D> node = first;
      for (node[0] = 0; node[0] < grid.nodes[0]; ++node[0]) {
        std::uint8_t& here = kind[grid.at(node)];
        if (here == beyond) continue;
        bool on_face = false;
        for (int d = 0; d < D; ++d) {
          if (grid.periodic[d] || (node[d] != 0 && node[d] != grid.nodes[d] - 1)) continue;
          touches[static_cast<std::size_t>(d)] = true;
          on_face = on_face || grid.given_faces(d);
        }
        if (on_face) {
          here = given;
        } else {
          ++unknowns;
        }
      }
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
  constexpr std::ptrdiff_t extent = NarrowBand<T, D>::extent;
  const LevelGrid<D>& grid = domain.grid;
  domain.kind.assign(grid.size(), beyond);
  const Index<D>& blocks = band.values().block_grid();
  for_each_piece(execution, static_cast<std::size_t>(product(blocks)), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      Index<D> block, last;
      auto rest = static_cast<std::ptrdiff_t>(k);
      for (int d = 0; d < D; ++d) {
        block[d] = rest % blocks[d];
        rest /= blocks[d];
        last[d] = std::min((block[d] + 1) * extent, grid.nodes[d]) - 1;
      }
      const std::ptrdiff_t b = band.values().find(block);
      const bool far_inside = band.far_value(block) < T(0);
      for_each_row<D>(block * extent, last, [&](const Index<D>& row) {
        std::uint8_t* const to = domain.kind.data() + grid.at(row);
        const std::ptrdiff_t count = last[0] - row[0] + 1;
        const T* const phi =
            b < 0 ? nullptr
                  : band.values().block(static_cast<std::size_t>(b)).data() + Field<T, D, Sparse>::offset(row);
        for (std::ptrdiff_t i = 0; i < count; ++i) {
          const bool inside = phi ? phi[i] < T(0) : far_inside;
          to[i] = inside == (side == Side::inside) ? plain : beyond;
        }
      });
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
    patch.read_block(band, b, K::support / 2);
    for (std::size_t i = 0; i < NarrowBand<T, D>::volume; ++i) {
      const Index<D> node = band.values().node(b, i);
      if (!band.lattice().contains(node) || domain.kind[domain.grid.at(node)] != plain) continue;
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
    }
  });
  domain.nodes.clear();
  for (const auto& nodes : found) domain.nodes.insert(domain.nodes.end(), nodes.begin(), nodes.end());
  domain.sort_cut_nodes();
}

/// The domain on nodes 2 i of a finer one: its legs are two of those, and end where the first of them is cut.
template <int D>
CutDomain<D> coarsen(const CutDomain<D>& fine, const LevelGrid<D>& grid) {
  CutDomain<D> coarse(grid);
  coarse.kind.assign(grid.size(), beyond);
  const Index<D> last = grid.nodes - Index<D>::constant(1);
  const auto each = [&](auto&& f) {
    for_each_row<D>(Index<D>{}, last, [&](const Index<D>& first) {
      Index<D> node = first;
      for (node[0] = 0; node[0] < grid.nodes[0]; ++node[0]) f(node, node * std::ptrdiff_t{2});
    });
  };
  each([&](const Index<D>& node, const Index<D>& from) {
    for (int d = 0; d < D; ++d) {
      if (from[d] >= fine.grid.nodes[d]) return;  // only where the domain does not touch the wall
    }
    coarse.kind[grid.at(node)] = fine.in_domain(from) ? plain : beyond;
  });
  coarse.find_given();
  each([&](const Index<D>& node, const Index<D>& from) {
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
    if (crossed) coarse.nodes.push_back(candidate);
  });
  coarse.sort_cut_nodes();
  return coarse;
}

/// Coefficients of -h^2 Lap along the legs of a cut node, from quadratic polynomials through it and the two ends of its
/// legs along each axis (Shortley and Weller 1938; the quadratic ghost values of Gibou et al., J. Comput. Phys. 176
/// (2002), give the same): with lengths a and b the ends have 2 / (a (a + b)) and 2 / (b (a + b)), and the node 2 / (a
/// b). All are scaled so that the node has `diagonal`, as plain nodes have: a crossing at any distance is as good as
/// another, and at distance 0 the row says that the node has the value of the interface.
template <int D>
struct CutWeights {
  std::array<double, 2 * static_cast<std::size_t>(D)> leg{};
  double scale = 1.0;  ///< of the right-hand side

  /// \param shift  s h^2
  CutWeights(const CutNode<D>& node, double diagonal, double shift) {
    for (std::size_t k = 0; k < leg.size(); ++k) {
      if (node.leg[k] < 0.0 || node.leg[k] >= on_interface) continue;
      leg[k] = diagonal;
      scale = 0.0;
      return;
    }
    double sum = shift;
    for (std::size_t d = 0; d < D; ++d) {
      const double a = node.leg[2 * d] < 0.0 ? 1.0 : node.leg[2 * d];
      const double b = node.leg[2 * d + 1] < 0.0 ? 1.0 : node.leg[2 * d + 1];
      leg[2 * d] = 2.0 / (a * (a + b));
      leg[2 * d + 1] = 2.0 / (b * (a + b));
      sum += 2.0 / (a * b);
    }
    scale = diagonal / sum;
    for (double& weight : leg) weight *= scale;
  }

 private:
  /// Distances that change the row by no more than 1e-14 of itself.
  static constexpr double on_interface = 1e-14;
};

/// Gives a level the unknowns and rows of a domain.
template <class T, int D>
void take_domain(const CutDomain<D>& domain, double shift, Level<T, D>& level) {
  level.diagonal = 2.0 * D + shift;
  level.unknowns.clear();
  level.regular.clear();
  level.count = 0;
  const LevelGrid<D>& grid = domain.grid;
  for_each_row<D>(Index<D>{}, grid.nodes - Index<D>::constant(1), [&](const Index<D>& first) {
    Index<D> node = first;
    const std::uint8_t* const kind = domain.kind.data() + grid.at(first);
    const auto end_of = [&](std::ptrdiff_t i, auto&& belongs) {
      while (i < grid.nodes[0] && belongs(kind[i])) ++i;
      return i;
    };
    for (std::ptrdiff_t i = 0; i < grid.nodes[0];) {
      const std::ptrdiff_t end = end_of(i, [](std::uint8_t one) { return one == plain || one == cut; });
      node[0] = i;
      if (end > i) level.unknowns.push_back(make_run(grid, node, end - i, level.count));
      while (i < end) {
        node[0] = i;
        const std::ptrdiff_t stop = end_of(i, [](std::uint8_t one) { return one == plain; });
        if (stop > i) level.regular.push_back(make_run(grid, node, stop - i, level.count));
        level.count += std::max<std::ptrdiff_t>(stop - i, 1);
        i = std::max(stop, i + 1);
      }
      if (i < grid.nodes[0] && (kind[i] == beyond || kind[i] == given)) ++i;
    }
  });
  for (auto& rows : level.cut) rows.clear();
  for (const auto& node : domain.nodes) {
    const CutWeights<D> weights(node, level.diagonal, shift);
    CutRow<T, D> row{node.at, {}};
    std::ptrdiff_t sum = 0;
    for (int d = 0; d < D; ++d) sum += node.node[d];
    for (std::size_t k = 0; k < row.leg.size(); ++k) {
      row.leg[k] = node.leg[k] < 0.0 ? static_cast<T>(weights.leg[k]) : T(0);
    }
    level.cut[static_cast<std::size_t>(sum % 2)].push_back(row);
  }
}

}  // namespace cambium::detail
