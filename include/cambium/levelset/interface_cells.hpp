// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <cambium/levelset/cut_cell.hpp>
#include <cambium/levelset/edge_root.hpp>
#include <cambium/levelset/interface_projection.hpp>

namespace cambium::detail {

/// What the signs in a block tell, cells being known by their first node.
template <int D>
struct BlockCells {
  static constexpr int extent = BlockShape<D>::extent;
  bool cut = false;          ///< a cell of the block is cut by the interface
  std::size_t vertices = 0;  ///< edges that start in the block and are crossed
  /// Cells wholly inside, and cells cut, by their place along each axis.
  std::array<std::array<std::int32_t, extent>, D> inside{};
  std::array<std::array<std::int32_t, extent>, D> crossed{};
};

/// The cells of a lattice that the interface cuts, with the points where it crosses the edges of the lattice.
///
/// \tparam K  interpolating kernel whose interpolant's zero set the interface is
template <class K, class T, int D>
class InterfaceCells {
 public:
  using Band = NarrowBand<T, D>;
  using Cell = CutCell<D>;
  using Edges = CellEdges<D>;
  /// Nodes that the patch of a block has around it.
  static constexpr std::ptrdiff_t halo = InterfaceProjection<K, T, D>::halo;

  /// \param curved  crossings of the kernel's interpolant, else of the linear one
  /// \throws InterfaceError if there is no interface, it touches a bounded face, or reaches blocks that are not stored;
  ///         ValueError if a value is not finite
  template <Execution E>
  InterfaceCells(const Band& band, bool curved, const E& execution) : band_(band) {
    if (band.blocks() == 0) throw InterfaceError("the band is empty: there is no interface to measure or extract");
    blocks_.resize(band.blocks());
    for_each_patch(band.blocks(), 1, execution,
                   [&](const auto& patch, std::size_t b, std::size_t) { look_at(patch, b, blocks_[b]); });
    number_vertices();
    for_each_patch(cut_.size(), halo, execution,
                   [&](const auto& patch, std::size_t k, std::size_t) { find_vertices(patch, k, curved); });
  }

  const Band& band() const { return band_; }
  const std::vector<BlockCells<D>>& blocks() const { return blocks_; }
  std::size_t vertices() const { return point_.size(); }
  /// Number of blocks with cells that the interface cuts.
  std::size_t cut_blocks() const { return cut_.size(); }
  /// Crossing v in spacings from the first node of the lattice; on periodic axes the last cell ends one spacing behind
  /// the last node.
  const Vec<D>& point(std::size_t v) const { return point_[v]; }
  /// Outward normal, and curvature per spacing, of the interpolant at crossing v.
  const Vec<D>& normal(std::size_t v) const { return normal_[v]; }
  double curvature(std::size_t v) const { return curvature_[v]; }

  /// A cell that the interface cuts.
  struct Place {
    std::size_t block;                                      ///< of the cut ones, 0, ..., cut_blocks() - 1
    std::size_t worker;                                     ///< of the execution; it does one block after another
    Index<D> node;                                          ///< the first of the cell
    int inside;                                             ///< bit c tells the side of corner c
    std::array<std::size_t, Cell::most_vertices> number{};  ///< of the crossing at a vertex that is on an edge
  };
  /// Calls f(place, patch, cell) for all cells cut; `patch` is that of the block.
  template <Execution E, class F>
  void for_each_cell(const E& execution, F&& f) const {
    for_each_patch(cut_.size(), halo, execution, [&](const Patch<T, D>& patch, std::size_t k, std::size_t worker) {
      Cell cell;
      for (std::size_t i = 0; i < Band::volume; ++i) {
        std::array<T, Edges::corners> value;
        const int inside = read_corners(patch, patch.entry(i), value);
        if (inside == 0 || inside == (1 << Edges::corners) - 1) continue;
        Place place{k, worker, band_.values().node(cut_[k], i), inside, {}};
        if (!has_cell(place.node)) continue;
        read_cell(value, place, cell);
        f(static_cast<const Place&>(place), patch, static_cast<const Cell&>(cell));
      }
    });
  }
  /// True if a cell starts at a node.
  bool has_cell(const Index<D>& node) const {
    for (int d = 0; d < D; ++d) {
      const std::ptrdiff_t n = band_.lattice().nodes()[d];
      if (node[d] >= (band_.lattice().periodic(d) ? n : n - 1)) return false;
    }
    return true;
  }

 private:
  static constexpr std::int16_t none = -1;

  /// Calls f(patch, k, worker): for all blocks, or with a halo of the stencil for those that are cut.
  template <Execution E, class F>
  void for_each_patch(std::size_t count, std::ptrdiff_t nodes_around, const E& execution, F&& f) const {
    std::vector<Patch<T, D>> patches(static_cast<std::size_t>(execution.count()));
    for_each_piece_by_worker(execution, count, 1, [&](std::size_t worker, std::size_t k, std::size_t) {
      patches[worker].read_block(band_, nodes_around == 1 ? k : cut_[k], nodes_around);
      f(static_cast<const Patch<T, D>&>(patches[worker]), k, worker);
    });
  }
  static int read_corners(const Patch<T, D>& patch, std::ptrdiff_t at, std::array<T, Edges::corners>& value) {
    int inside = 0;
    for (int c = 0; c < Edges::corners; ++c) {
      std::ptrdiff_t corner = at;
      for (int d = 0; d < D; ++d) corner += (c >> d & 1) * patch.stride()[d];
      value[c] = patch[corner];
      inside |= (value[c] < T(0) ? 1 : 0) << c;
    }
    return inside;
  }

  void look_at(const Patch<T, D>& patch, std::size_t b, BlockCells<D>& block) const {
    bool negative = false, positive = false, finite = true;
    for (std::ptrdiff_t i = 0; i < product(patch.edge()); ++i) {
      const T value = patch[i];
      negative |= value < T(0);
      positive |= value >= T(0);
      finite &= std::isfinite(value);
    }
    if (!finite) refuse(b);
    if (!negative) return;
    for (std::size_t i = 0; i < Band::volume; ++i) {
      const Index<D> node = band_.values().node(b, i);
      if (!band_.lattice().contains(node)) continue;
      std::array<T, Edges::corners> value;
      const int inside = positive ? read_corners(patch, patch.entry(i), value) : (1 << Edges::corners) - 1;
      if (inside == 0) continue;
      const bool whole = inside == (1 << Edges::corners) - 1;
      if (has_cell(node)) {
        for (int d = 0; d < D; ++d) ++(whole ? block.inside : block.crossed)[d][place(i, d)];
        block.cut |= !whole;
      }
      for (int d = 0; d < D && !whole; ++d) {
        if ((inside & 1) == (inside >> (1 << d) & 1)) continue;
        ++block.vertices;
        check_surroundings(node, d);
      }
    }
  }
  static std::size_t place(std::size_t i, int axis) {
    for (int d = 0; d < axis; ++d) i /= Band::extent;
    return i % Band::extent;
  }
  void refuse(std::size_t b) const {
    for (std::size_t i = 0; i < Band::volume; ++i) {
      const Index<D> node = band_.values().node(b, i);
      if (!band_.lattice().contains(node) || std::isfinite(band_.values().block(b)[i])) continue;
      throw ValueError(message("the level set is ", band_.values().block(b)[i], " at node ", node,
                               ": values must be finite; check the velocity or the formula it comes from"));
    }
  }
  /// All cells around a crossed edge must exist, and start in stored blocks.
  void check_surroundings(const Index<D>& node, int axis) const {
    const Lattice<D>& lattice = band_.lattice();
    for (int d = 0; d < D; ++d) {
      if (d == axis || lattice.periodic(d) || (node[d] > 0 && node[d] < lattice.nodes()[d] - 1)) continue;
      throw InterfaceError(message("the interface touches the box at node ", node, ", on a face of axis ", d,
                                   ": enlarge the box or make that axis periodic"));
    }
    for (int c = 1; c < Edges::corners; ++c) {
      if (c >> axis & 1) continue;
      Index<D> from = node;
      for (int d = 0; d < D; ++d) from[d] -= c >> d & 1;
      if (band_.values().find(band_.values().block_of(band_.inside(from))) < 0) refuse_thin(node);
    }
  }
  [[noreturn]] static void refuse_thin(const Index<D>& node) {
    throw InterfaceError(
        message("the interface at node ", node, " reaches a block where no values are kept: widen the band"));
  }

  void number_vertices() {
    std::size_t total = 0;
    slot_.assign(blocks_.size(), -1);
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      if (!blocks_[b].cut && blocks_[b].vertices == 0) continue;
      slot_[b] = static_cast<std::int32_t>(cut_.size());
      cut_.push_back(b);
      first_.push_back(total);
      total += blocks_[b].vertices;
    }
    if (total == 0) {
      throw InterfaceError("the level set has no zero crossing: there is no interface to measure or extract");
    }
    at_edge_.assign(cut_.size() * Band::volume * D, none);
    point_.resize(total);
    normal_.resize(total);
    curvature_.resize(total);
  }

  void find_vertices(const Patch<T, D>& patch, std::size_t k, bool curved) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < Band::volume; ++i) {
      const std::ptrdiff_t at = patch.entry(i);
      const Index<D> node = band_.values().node(cut_[k], i);
      if (!band_.lattice().contains(node)) continue;
      for (int d = 0; d < D; ++d) {
        const std::ptrdiff_t stride = patch.stride()[d];
        if ((patch[at] < T(0)) == (patch[at + stride] < T(0))) continue;
        const T* value = patch.data() + at;
        const double t = curved ? EdgeRoot<K, T>::find(value, stride) : EdgeRoot<K, T>::linear(value, stride);
        const std::size_t v = first_[k] + count;
        at_edge_[(k * Band::volume + i) * D + static_cast<std::size_t>(d)] = static_cast<std::int16_t>(count++);
        for (int e = 0; e < D; ++e) point_[v][e] = static_cast<double>(node[e]);
        point_[v][d] += t;
        Vec<D, T> y = patch.position(at);
        y[d] += static_cast<T>(t);
        const Jet<T, D> jet = Interpolant<K, T, D>::jet(patch.data(), patch.stride(), y);
        const T slope = norm(jet.gradient);
        for (int e = 0; e < D; ++e) normal_[v][e] = static_cast<double>(jet.gradient[e] / slope);
        curvature_[v] = static_cast<double>(cambium::curvature(jet));
      }
    }
  }

  void read_cell(const std::array<T, Edges::corners>& value, Place& place, Cell& cell) const {
    std::array<double, Edges::count> crossing{};
    std::array<std::size_t, Edges::count> on_edge{};
    for (int e = 0; e < Edges::count; ++e) {
      const int corner = Edges::corner(e), axis = Edges::axis(e);
      if ((place.inside >> corner & 1) == (place.inside >> (corner | 1 << axis) & 1)) continue;
      Index<D> from = place.node;
      for (int d = 0; d < D; ++d) from[d] += corner >> d & 1;
      from = band_.inside(from);
      const std::ptrdiff_t b = band_.values().find(band_.values().block_of(from));
      if (b < 0) refuse_thin(from);
      const auto k = static_cast<std::size_t>(slot_[static_cast<std::size_t>(b)]);
      const std::size_t entry = (k * Band::volume + band_.values().offset(from)) * D;
      on_edge[e] = first_[k] + static_cast<std::size_t>(at_edge_[entry + static_cast<std::size_t>(axis)]);
      crossing[e] = point_[on_edge[e]][axis] - static_cast<double>(from[axis]);
    }
    cell.cut(value, crossing);
    for (int v = 0; v < cell.vertices; ++v) {
      if (cell.edge[v] >= 0) place.number[v] = on_edge[cell.edge[v]];
    }
  }

  const Band& band_;
  std::vector<BlockCells<D>> blocks_;
  std::vector<std::size_t> cut_;       ///< blocks that are cut
  std::vector<std::int32_t> slot_;     ///< place of a block in cut_, or -1
  std::vector<std::size_t> first_;     ///< number of the first crossing of a cut block
  std::vector<std::int16_t> at_edge_;  ///< crossing on an edge of a cut block, counted from its first
  std::vector<Vec<D>> point_;
  std::vector<Vec<D>> normal_;
  std::vector<double> curvature_;
};

}  // namespace cambium::detail
