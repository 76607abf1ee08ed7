// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include <cambium/levelset/cut_cell.hpp>

namespace cambium::detail {

/// Volume of a body and the integral of the position over it.
template <int D>
struct Moments {
  double volume = 0.0;
  Vec<D> first{};

  Moments& operator+=(const Moments& other) {
    volume += other.volume;
    first += other.first;
    return *this;
  }
  /// The same body, moved.
  Moments moved(const Vec<D>& by) const { return {volume, first + volume * by}; }
};

/// Area of a flat element times its normal: of a segment, on its right; of a triangle, by the right-hand rule.
template <int D>
Vec<D> area_vector(const std::array<Vec<D>, D>& x) {
  const Vec<D> a = x[1] - x[0];
  if constexpr (D == 2) {
    return {a[1], -a[0]};
  } else {
    const Vec<D> b = x[2] - x[0];
    return Vec<3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]} * 0.5;
  }
}

/// Moments of the part of the unit cell that is inside, by the divergence theorem in the cell with fields along axis 0:
/// div (x_0, 0, 0) = 1. The flux through a flat element is exact, that through the face x_0 = 1 is the moment of the
/// part of the face that is inside, found in the same way, down to an interval on an edge. What happens in other cells
/// does not matter: bodies that wrap around a periodic box have their volume, too.
template <int D>
class CellMoments {
 public:
  /// \param inside  bit c tells whether corner c is inside
  static Moments<D> of(const CutCell<D>& cell, int inside) {
    Moments<2> square = lift(edge_moments(cell, inside));
    if constexpr (D == 2) {
      for (int e = 0; e < cell.elements; ++e) {
        add_flux<2>({cell.point[cell.element[e][0]], cell.point[cell.element[e][1]]}, square);
      }
      return square;
    } else {
      const auto on_face = [&](int v) { return Vec<2>{cell.point[v][1], cell.point[v][2]}; };
      for (int s = 0; s < cell.segments; ++s) {
        add_flux<2>({on_face(cell.segment[s][0]), on_face(cell.segment[s][1])}, square);
      }
      Moments<3> cube = lift(square);
      for (int e = 0; e < cell.elements; ++e) {
        const auto& v = cell.element[e];
        add_flux<3>({cell.point[v[0]], cell.point[v[1]], cell.point[v[2]]}, cube);
      }
      return cube;
    }
  }

 private:
  /// The part inside of the edge along the last axis at x_d = 1 for all others.
  static Moments<1> edge_moments(const CutCell<D>& cell, int inside) {
    constexpr int corner = (1 << (D - 1)) - 1;
    constexpr int edge = CellEdges<D>::along(D - 1, corner);
    const bool at_start = inside >> corner & 1;
    const bool at_end = inside >> (corner | 1 << (D - 1)) & 1;
    double crossing = at_end ? 0.0 : 1.0;
    for (int v = 0; v < cell.vertices; ++v) {
      if (cell.edge[v] == edge) crossing = cell.point[v][D - 1];
    }
    if (!at_start && !at_end) return {};
    const double from = at_start ? 0.0 : crossing;
    const double to = at_end ? 1.0 : crossing;
    return {to - from, {0.5 * (to * to - from * from)}};
  }
  /// Fluxes of (x_0, 0, ...) and of (x_0^2 / 2, 0, ...), (x_0 x_e, 0, ...) through the face x_0 = 1.
  template <int N>
  static Moments<N + 1> lift(const Moments<N>& face) {
    Moments<N + 1> result{face.volume, {}};
    result.first[0] = 0.5 * face.volume;
    for (int d = 0; d < N; ++d) result.first[d + 1] = face.first[d];
    return result;
  }
  /// The same fluxes through a flat element; the mean of x y over one with n corners is
  /// (sum x sum y + sum x y) / (n (n + 1)).
  template <int N>
  static void add_flux(const std::array<Vec<N>, N>& x, Moments<N>& to) {
    const double area = area_vector<N>(x)[0];
    Vec<N> sum{}, product{};
    for (const Vec<N>& corner : x) {
      sum += corner;
      product += corner[0] * corner;
    }
    to.volume += sum[0] / N * area;
    for (int d = 0; d < N; ++d) {
      to.first[d] += (sum[0] * sum[d] + product[d]) / (N * (N + 1)) * area * (d == 0 ? 0.5 : 1.0);
    }
  }
};

}  // namespace cambium::detail
