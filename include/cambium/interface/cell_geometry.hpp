// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <cambium/interface/side.hpp>
#include <cambium/levelset/cell_moments.hpp>
#include <cambium/levelset/jet.hpp>
#include <cambium/levelset/patch.hpp>
#include <cambium/multigrid/level.hpp>

namespace cambium::detail {

/// The open part of the face between a node and the next one along an axis, where the interface cuts the face.
template <int D>
struct CutFace {
  Index<D> node;
  int axis;
  double open;   ///< its share of the face, in (0, 1)
  Vec<D> aside;  ///< from the middle of the face to that of its open part, in spacings
};

/// A flat piece of the interface in the cell around a node.
template <int D>
struct WallPiece {
  Index<D> node;
  double area;    ///< in spacings^(D - 1)
  Vec<D> middle;  ///< from the node, in spacings
};

/// A cell that the interface cuts.
template <int D>
struct CutVolume {
  Index<D> node;
  double volume;  ///< its share of the cell that is in the domain
};

/// Parts of the cells around nodes (cubes of one spacing, halved at walls) that lie on one side of an interface.
///
/// Flat pieces between the crossings of the cells' edges bound them: volumes, faces and the interface's pieces of a
/// cell close exactly, and are of second order. phi at the corners of cells is that of kernel K's interpolant.
template <class K, int D>
class CellGeometry {
 public:
  static constexpr int corners = 1 << D;

  std::vector<CutFace<D>> faces;
  std::vector<WallPiece<D>> pieces;
  std::vector<CutVolume<D>> volumes;

  /// \throws InterfaceError if the interface is within two spacings of a wall
  template <class T, Execution E>
  CellGeometry(const NarrowBand<T, D>& band, Side side, const LevelGrid<D>& grid, const E& execution)
      : grid_(grid), sign_(side == Side::inside ? 1.0 : -1.0) {
    corner_.assign(grid.size(), none);
    find_corners(band, execution);
    for (std::size_t k = 0; k < near_.size(); ++k) look_at(near_[k]);
  }

 private:
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  /// phi at the corners (half a spacing up every axis from a node) around which the signs of nodes differ.
  template <class T, Execution E>
  void find_corners(const NarrowBand<T, D>& band, const E& execution) {
    std::vector<Patch<T, D>> patches(static_cast<std::size_t>(execution.count()));
    std::vector<std::vector<Index<D>>> found(band.blocks());
    for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
      Patch<T, D>& patch = patches[worker];
      patch.read_block(band, b, K::support / 2 + 1);
      for (std::size_t i = 0; i < NarrowBand<T, D>::volume; ++i) {
        const Index<D> node = band.values().node(b, i);
        if (!band.lattice().contains(node) || !mixed(patch, patch.entry(i))) continue;
        require_room(node);
        const Vec<D, T> middle = patch.position(patch.entry(i)) + Vec<D, T>::constant(T(0.5));
        corner_[grid_.at(node)] =
            sign_ * static_cast<double>(Interpolant<K, T, D>::value(patch.data(), patch.stride(), middle));
        found[b].push_back(node);
      }
    });
    // If the nodes next to a node differ in sign, all corners of its cell are among those.
    for (const auto& nodes : found) near_.insert(near_.end(), nodes.begin(), nodes.end());
  }
  /// True if the 4^D nodes around the corner up from an entry are not all on one side.
  template <class T>
  static bool mixed(const Patch<T, D>& patch, std::ptrdiff_t at) {
    const bool inside = patch[at] < T(0);
    for (int k = 0; k < 1 << (2 * D); ++k) {
      std::ptrdiff_t to = at;
      for (int d = 0; d < D; ++d) to += ((k >> (2 * d) & 3) - 1) * patch.stride()[d];
      if ((patch[to] < T(0)) != inside) return true;
    }
    return false;
  }
  void require_room(const Index<D>& node) const {
    for (int d = 0; d < D; ++d) {
      if (grid_.periodic[d] || (node[d] >= 1 && node[d] + 2 < grid_.nodes[d])) continue;
      throw InterfaceError(message("the interface is within two spacings of the box at node ", node,
                                   ", on a face of axis ", d, ": enlarge the box or make that axis periodic"));
    }
  }
  Index<D> wrapped(Index<D> node) const {
    for (int d = 0; d < D; ++d) {
      if (!grid_.periodic[d]) continue;
      node[d] = (node[d] + grid_.nodes[d]) % grid_.nodes[d];
    }
    return node;
  }
  double corner(const Index<D>& node) const { return corner_[grid_.at(wrapped(node))]; }

  /// The cell around a node and its upper faces.
  void look_at(const Index<D>& node) {
    std::array<double, corners> value{};
    for (int c = 0; c < corners; ++c) {
      Index<D> from = node;
      for (int d = 0; d < D; ++d) from[d] -= 1 - (c >> d & 1);
      value[c] = corner(from);
      if (std::isnan(value[c])) return;
    }
    cut_volume(node, value);
    for (int d = 0; d < D; ++d) cut_face(node, d, value);
  }
  void cut_volume(const Index<D>& node, const std::array<double, corners>& value) {
    int inside = 0;
    for (int c = 0; c < corners; ++c) inside |= (value[c] < 0.0 ? 1 : 0) << c;
    if (inside == 0 || inside == (1 << corners) - 1) {
      volumes.push_back({node, inside == 0 ? 0.0 : 1.0});
      return;
    }
    const CutCell<D> cell = cut<D>(value);
    volumes.push_back({node, CellMoments<D>::of(cell, inside).volume});
    for (int e = 0; e < cell.elements; ++e) {
      std::array<Vec<D>, D> x;
      Vec<D> middle{};
      for (int c = 0; c < D; ++c) {
        x[c] = cell.point[cell.element[e][c]];
        middle += x[c];
      }
      const double area = norm(area_vector<D>(x));
      if (area > 0.0) pieces.push_back({node, area, middle / static_cast<double>(D) - Vec<D>::constant(0.5)});
    }
  }
  void cut_face(const Index<D>& node, int axis, const std::array<double, corners>& value) {
    std::array<double, corners / 2> on_face{};
    int inside = 0;
    for (int c = 0; c < corners / 2; ++c) {
      const int below = c & ((1 << axis) - 1);
      on_face[c] = value[below | 1 << axis | (c >> axis) << (axis + 1)];
      inside |= (on_face[c] < 0.0 ? 1 : 0) << c;
    }
    if (inside == 0) {
      faces.push_back({node, axis, 0.0, {}});
    } else if (inside == (1 << (corners / 2)) - 1) {
      faces.push_back({node, axis, 1.0, {}});
    } else {
      const Moments<D - 1> open = open_part(on_face, inside);
      Vec<D> aside{};
      for (int d = 0, e = 0; d < D; ++d) {
        if (d == axis) continue;
        if (open.volume > 0.0) aside[d] = open.first[e] / open.volume - 0.5;
        ++e;
      }
      faces.push_back({node, axis, open.volume, aside});
    }
  }
  static Moments<D - 1> open_part(const std::array<double, corners / 2>& value, int inside) {
    if constexpr (D == 2) {
      const double t = value[0] / (value[0] - value[1]);
      const double from = inside & 1 ? 0.0 : t, to = inside & 1 ? t : 1.0;
      return {to - from, {0.5 * (to * to - from * from)}};
    } else {
      return CellMoments<2>::of(cut<2>(value), inside);
    }
  }
  /// The cell cut where phi is linear along its edges.
  template <int N>
  static CutCell<N> cut(const std::array<double, 1 << N>& value) {
    std::array<double, CellEdges<N>::count> crossing{};
    for (int e = 0; e < CellEdges<N>::count; ++e) {
      const double a = value[CellEdges<N>::corner(e)];
      const double b = value[CellEdges<N>::corner(e) | 1 << CellEdges<N>::axis(e)];
      if ((a < 0.0) != (b < 0.0)) crossing[e] = a / (a - b);
    }
    CutCell<N> cell;
    cell.cut(value, crossing);
    return cell;
  }

  const LevelGrid<D>& grid_;
  double sign_;
  std::vector<double> corner_;
  std::vector<Index<D>> near_;
};

}  // namespace cambium::detail
