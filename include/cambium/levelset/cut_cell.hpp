// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include <cambium/core/vec.hpp>

namespace cambium::detail {

/// Corners and edges of a lattice cell. Bit d of the number of a corner tells its side along axis d.
template <int D>
struct CellEdges {
  static constexpr int corners = 1 << D;
  static constexpr int count = D << (D - 1);

  /// Number of the edge along `axis` that starts or ends at `corner`.
  static constexpr int along(int axis, int corner) {
    const int below = corner & ((1 << axis) - 1);
    const int above = corner >> (axis + 1);
    return axis * (1 << (D - 1)) + (below | above << axis);
  }
  static constexpr int axis(int edge) { return edge >> (D - 1); }
  /// The corner at which an edge starts.
  static constexpr int corner(int edge) {
    const int rest = edge & ((1 << (D - 1)) - 1);
    const int below = rest & ((1 << axis(edge)) - 1);
    return below | (rest >> axis(edge)) << (axis(edge) + 1);
  }
  /// The 2 D faces as bits, 2 axis + side, that an edge lies in.
  static constexpr int faces(int edge) {
    int result = 0;
    for (int d = 0; d < D; ++d) {
      if (d != axis(edge)) result |= 1 << (2 * d + (corner(edge) >> d & 1));
    }
    return result;
  }
};

/// The lines in which the interface cuts a square with corners 0, 1, 2, 3 anticlockwise and sides i = (i, i + 1).
struct SquareCut {
  int count = 0;
  std::array<int, 2> from{};  ///< side at which a line starts; the inside is on its left
  std::array<int, 2> to{};
  bool joined = false;  ///< two opposite corners are inside and connected across the square

  /// Where opposite corners are on the same side, the saddle of the bilinear interpolant decides which are connected
  /// (Nielson & Hamann 1991): a rule that gives both cells at a face the same answer.
  template <class T>
  static SquareCut of(const std::array<T, 4>& value) {
    SquareCut cut;
    for (int i = 0; i < 4; ++i) {
      if (value[i] < T(0) && !(value[(i + 1) % 4] < T(0))) cut.from[cut.count++] = i;
    }
    if (cut.count == 1) {
      for (int i = 0; i < 4; ++i) {
        if (!(value[i] < T(0)) && value[(i + 1) % 4] < T(0)) cut.to[0] = i;
      }
    } else if (cut.count == 2) {
      const T even = value[0] * value[2];
      const T odd = value[1] * value[3];
      cut.joined = value[0] < T(0) ? even > odd : odd > even;
      for (int k = 0; k < 2; ++k) cut.to[k] = (cut.from[k] + (cut.joined ? 1 : 3)) % 4;
    }
    return cut;
  }
};

/// The piece of the interface in one cell as flat elements (segments in 2D, triangles in 3D) between its crossings with
/// the edges, the normal by the right-hand rule (3D) or on the right (2D) pointing outwards. Elements of neighbouring
/// cells share the sides on the face between them, so that the whole is closed.
template <int D>
struct CutCell {
  using Edges = CellEdges<D>;
  static constexpr int most_vertices = D == 2 ? 4 : 16;  ///< the edges, and the middle of every loop
  static constexpr int most_elements = D == 2 ? 2 : 12;

  int vertices = 0;
  std::array<int, most_vertices> edge;      ///< that a vertex lies on, or -1: in the middle of the cell
  std::array<Vec<D>, most_vertices> point;  ///< vertices, in spacings from corner 0
  int elements = 0;
  std::array<std::array<int, D>, most_elements> element;  ///< their vertices
  int segments = 0;                                       ///< 3D: sides on the far face of axis 0
  std::array<std::array<int, 2>, 2> segment;              ///< their vertices, inside on the left seen from outside
  int joins = 0;
  std::array<std::array<int, 2>, 6> join;  ///< corners inside that are connected across a face

  /// \param value     of the corners
  /// \param crossing  distance of the crossing from the start of every edge that has one, in spacings
  template <class T>
  void cut(const std::array<T, Edges::corners>& value, const std::array<double, Edges::count>& crossing) {
    vertices = elements = segments = joins = 0;
    number_.fill(-1);
    for (int e = 0; e < Edges::count; ++e) {
      const int from = Edges::corner(e);
      if ((value[from] < T(0)) == (value[from | 1 << Edges::axis(e)] < T(0))) continue;
      number_[e] = vertices;
      edge[vertices] = e;
      for (int d = 0; d < D; ++d) point[vertices][d] = from >> d & 1;
      point[vertices++][Edges::axis(e)] = crossing[e];
    }
    if constexpr (D == 2) {
      cut_face(value, 2, 0, [&](int a, int b) { element[elements++] = {number_[a], number_[b]}; });
    } else {
      next_.fill(-1);
      for (int axis = 0; axis < 3; ++axis) {
        cut_face(value, axis, 0, [&](int a, int b) { next_[a] = b; });
        cut_face(value, axis, 1, [&](int a, int b) {
          next_[b] = a;
          if (axis == 0) segment[segments++] = {number_[a], number_[b]};
        });
      }
      for (int e = 0; e < Edges::count; ++e) {
        if (next_[e] >= 0) add_loop(e);
      }
    }
  }

 private:
  /// Calls f(a, b) for the lines from edge a to edge b in a face, the inside on the left seen from where `axis` points.
  template <class T, class F>
  void cut_face(const std::array<T, Edges::corners>& value, int axis, int side, F&& f) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const int base = side << axis;
    const std::array<int, 4> corner = {base, base | 1 << u, base | 1 << u | 1 << v, base | 1 << v};
    const SquareCut lines =
        SquareCut::of(std::array<T, 4>{value[corner[0]], value[corner[1]], value[corner[2]], value[corner[3]]});
    const auto edge_of = [&](int i) { return Edges::along(i % 2 == 0 ? u : v, corner[i]); };
    for (int k = 0; k < lines.count; ++k) f(edge_of(lines.from[k]), edge_of(lines.to[k]));
    if (lines.joined) join[joins++] = {corner[lines.from[0]], corner[lines.from[1]]};
  }
  /// The loop that starts at an edge, cut into triangles.
  void add_loop(int start) {
    std::array<int, Edges::count> loop{};
    int size = 0;
    for (int e = start; next_[e] >= 0;) {
      loop[size++] = number_[e];
      const int to = next_[e];
      next_[e] = -1;
      e = to;
    }
    const int apex = best_apex(loop, size);
    if (apex >= 0) {
      for (int k = 1; k + 1 < size; ++k) {
        element[elements++] = {loop[apex], loop[(apex + k) % size], loop[(apex + k + 1) % size]};
      }
      return;
    }
    Vec<D> middle{};
    for (int k = 0; k < size; ++k) middle += point[loop[k]] / static_cast<double>(size);
    edge[vertices] = -1;
    point[vertices] = middle;
    for (int k = 0; k < size; ++k) element[elements++] = {vertices, loop[k], loop[(k + 1) % size]};
    ++vertices;
  }
  /// The corner of a loop from which the diagonals are shortest, of those from which none lies in a face (the other
  /// cell at the face might have the same diagonal). \return -1 if there is none
  int best_apex(const std::array<int, Edges::count>& loop, int size) const {
    int best = -1;
    double shortest = 0.0;
    for (int apex = 0; apex < size; ++apex) {
      double length = 0.0;
      bool in_face = false;
      for (int k = 2; k + 1 < size; ++k) {
        const int a = loop[apex], b = loop[(apex + k) % size];
        const Vec<D> diagonal = point[a] - point[b];
        length += dot(diagonal, diagonal);
        in_face |= (Edges::faces(edge[a]) & Edges::faces(edge[b])) != 0;
      }
      if (in_face || (best >= 0 && !(length < shortest))) continue;
      best = apex;
      shortest = length;
    }
    return best;
  }

  std::array<int, Edges::count> number_;  ///< vertex on an edge
  std::array<int, Edges::count> next_;    ///< edge to which the line from an edge leads, around its loop
};

}  // namespace cambium::detail
