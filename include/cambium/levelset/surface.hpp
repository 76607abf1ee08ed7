// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <cambium/kernels/lambda.hpp>
#include <cambium/levelset/interface_cells.hpp>

namespace cambium {

/// An interface as flat elements: triangles in 3D, segments in 2D.
///
/// Closed: every edge of a triangle (every end of a segment) belongs to exactly two elements, which run through it in
/// opposite ways. Normals point outwards: by the right-hand rule from the order of a triangle's vertices; on the right
/// of a segment from its first vertex to its second, so that curves run anticlockwise around the inside.
template <int D>
struct Surface {
  std::vector<Vec<D>> vertices;    ///< positions; across a periodic face they wrap
  std::vector<Vec<D>> normals;     ///< outward unit normals at the vertices
  std::vector<double> curvatures;  ///< sums of the principal curvatures at the vertices, per length
  std::vector<std::array<std::uint32_t, D>> elements;

  struct Params {
    /// Vertices on the zero set of the kernel's interpolant (error O(h^5) for Lambda_{4,4}), else on that of the linear
    /// interpolant along the edges of the lattice (error O(h^2)).
    bool projected = true;
  };
};

namespace detail {

/// Elements of the blocks one after another; vertices in the middle of cells are numbered behind all crossings.
template <class K, class T, int D>
class SurfaceBuilder {
 public:
  template <Execution E>
  Surface<D> operator()(const NarrowBand<T, D>& band, bool projected, const E& execution) {
    const InterfaceCells<K, T, D> cells(band, projected, execution);
    pieces_.assign(cells.cut_blocks(), {});
    cells.for_each_cell(execution, [&](const auto& place, const Patch<T, D>& patch, const CutCell<D>& cell) {
      add_cell(pieces_[place.block], place, patch, cell, projected);
    });
    Surface<D> surface;
    const Lattice<D>& lattice = band.lattice();
    const auto add_vertex = [&](const Vec<D>& u, const Vec<D>& normal, double curvature) {
      surface.vertices.push_back(lattice.domain().wrap(lattice.box().lo + u * lattice.spacing()));
      surface.normals.push_back(normal);
      surface.curvatures.push_back(curvature / lattice.spacing());
    };
    for (std::size_t v = 0; v < cells.vertices(); ++v) add_vertex(cells.point(v), cells.normal(v), cells.curvature(v));
    for (const Piece& piece : pieces_) {
      const std::size_t base = surface.vertices.size();
      for (const Middle& middle : piece.middles) add_vertex(middle.point, middle.normal, middle.curvature);
      for (auto element : piece.elements) {
        std::array<std::uint32_t, D> to;
        for (int c = 0; c < D; ++c) {
          to[c] = static_cast<std::uint32_t>(element[c] < 0 ? base + static_cast<std::size_t>(-1 - element[c])
                                                            : static_cast<std::size_t>(element[c]));
        }
        surface.elements.push_back(to);
      }
    }
    return surface;
  }

 private:
  struct Middle {
    Vec<D> point;
    Vec<D> normal;
    double curvature;
  };
  struct Piece {
    std::vector<std::array<std::int64_t, D>> elements;  ///< -1 - m stands for middle m
    std::vector<Middle> middles;
  };

  template <class Place>
  static void add_cell(Piece& piece, const Place& place, const Patch<T, D>& patch, const CutCell<D>& cell,
                       bool projected) {
    std::array<std::int64_t, CutCell<D>::most_vertices> id;
    for (int v = 0; v < cell.vertices; ++v) {
      id[v] = cell.edge[v] >= 0 ? static_cast<std::int64_t>(place.number[v])
                                : -1 - static_cast<std::int64_t>(piece.middles.size());
      if (cell.edge[v] < 0) piece.middles.push_back(middle(place.node, patch, cell.point[v], projected));
    }
    for (int e = 0; e < cell.elements; ++e) {
      std::array<std::int64_t, D> element;
      for (int c = 0; c < D; ++c) element[c] = id[cell.element[e][c]];
      piece.elements.push_back(element);
    }
  }
  static Middle middle(const Index<D>& node, const Patch<T, D>& patch, const Vec<D>& in_cell, bool projected) {
    Vec<D, T> y;
    for (int d = 0; d < D; ++d) y[d] = static_cast<T>(static_cast<double>(node[d] - patch.first()[d]) + in_cell[d]);
    if (projected) InterfaceProjection<K, T, D>(patch, T(1e-4))(y);
    const Jet<T, D> jet = Interpolant<K, T, D>::jet(patch.data(), patch.stride(), y);
    Middle result;
    for (int d = 0; d < D; ++d) {
      result.point[d] = static_cast<double>(y[d]) + static_cast<double>(patch.first()[d]);
      result.normal[d] = static_cast<double>(jet.gradient[d] / norm(jet.gradient));
    }
    result.curvature = static_cast<double>(curvature(jet));
    return result;
  }

  std::vector<Piece> pieces_;
};

}  // namespace detail

/// Extracts the interface of a band whose values are of any scaling, negative inside.
///
/// Vertices are the crossings of the lattice's edges (marching cubes, Lorensen & Cline 1987, with ambiguous faces
/// decided by the saddle of their bilinear interpolant); a vertex in the middle of a cell is added where no
/// triangulation of its polygon stays off the faces. A node that is exactly zero gives coinciding vertices and elements
/// without area. \tparam K  interpolating kernel of even support \throws InterfaceError if there is no interface, it
/// touches a bounded face of the box, or reaches blocks that are not
///         stored; ValueError if a value is not finite
template <class K = Lambda<4, 4>, class T, int D, Execution E = OpenMP>
Surface<D> extract_surface(const NarrowBand<T, D>& band, const typename Surface<D>::Params& params = {},
                           const E& execution = {}) {
  return detail::SurfaceBuilder<K, T, D>()(band, params.projected, execution);
}

/// The vertices of every closed curve of an interface in 2D, in the order of its segments.
inline std::vector<std::vector<std::uint32_t>> closed_curves(const Surface<2>& surface) {
  std::vector<std::uint32_t> next(surface.vertices.size());
  for (const auto& segment : surface.elements) next[segment[0]] = segment[1];
  std::vector<char> seen(next.size());
  std::vector<std::vector<std::uint32_t>> curves;
  for (std::uint32_t start = 0; start < next.size(); ++start) {
    if (seen[start]) continue;
    curves.emplace_back();
    for (std::uint32_t v = start; !seen[v]; v = next[v]) {
      seen[v] = 1;
      curves.back().push_back(v);
    }
  }
  return curves;
}

}  // namespace cambium
