// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include <cambium/levelset/cell_moments.hpp>
#include <cambium/simd/pack.hpp>

namespace cambium::detail {

/// A piece of a curved interface: the polynomial through points of it, integrated by Gauss quadrature.
///
/// Area, and moments of the body between the flat element and the curved one; bodies of neighbours fit together, since
/// they share a flat strip above the side between them.
template <int D>
struct CurvedElement;

/// Parabola through the two ends of a segment and a point between. Its area is wrong by the integral of a cubic error
/// that Simpson's rule integrates to zero: the error of lengths and areas is O(h^4).
template <>
struct CurvedElement<2> {
  static constexpr int sides = 1;
  /// Points that span an element: its corners, one above each side.
  using Nodes = std::array<Vec<2>, 3>;
  static constexpr std::array<std::array<int, 2>, 1> side = {{{0, 1}}};

  static double add_gap(const Nodes& x, Moments<2>& gap) {
    const Vec<2> middle = (x[0] + x[1]) * 0.5;
    const Vec<2> rise = x[2] - middle;
    // A segment of a parabola: 2/3 of base times height, its centroid at 2/5 of the height.
    gap += Moments<2>{2.0 / 3.0 * dot(rise, area_vector<2>({x[0], x[1]})), {}}.moved(middle + rise * 0.4);
    double length = 0.0;
    for (int q = 0; q < 4; ++q) {
      const double s = q < 2 ? -node[q] : node[q - 2];
      length += 0.5 * weight[q % 2] * norm(x[1] - x[0] - 4.0 * s * rise);
    }
    return length;
  }
  /// Calls f(point, normal) for the points of the rule that integrates over the element, the normal being as long as
  /// the point's weight.
  template <class F>
  static void for_each_point(const Nodes& x, F&& f) {
    const Vec<2> middle = (x[0] + x[1]) * 0.5;
    const Vec<2> rise = x[2] - middle;
    for (int q = 0; q < 4; ++q) {
      const double s = q < 2 ? -node[q] : node[q - 2];
      const Vec<2> along = (x[1] - x[0]) * 0.5 - 2.0 * s * rise;
      f(middle + (x[1] - x[0]) * (0.5 * s) + (1.0 - s * s) * rise, Vec<2>{along[1], -along[0]} * weight[q % 2]);
    }
  }

 private:
  static constexpr std::array<double, 2> node = {0.33998104358485626, 0.86113631159405258};
  static constexpr std::array<double, 2> weight = {0.65214515486254614, 0.34785484513745386};
};

/// Shape functions of seven points of a triangle (corners, sides, middle) at those of Radon's rule of degree 5 (Radon
/// 1948), whose weights add up to one.
struct SevenNodeTriangle {
  static constexpr int points = 7;
  /// By point of the triangle, then by point of the rule; the eighth entry of every row is zero.
  alignas(64) double weight[8]{};
  alignas(64) double value[7][8]{}, along_u[7][8]{}, along_v[7][8]{};

  constexpr SevenNodeTriangle() {
    constexpr double root = 3.8729833462074169;  // sqrt(15)
    constexpr double near = (6.0 - root) / 21.0, far = (6.0 + root) / 21.0;
    constexpr double place[points][2] = {{1.0 / 3.0, 1.0 / 3.0},   {near, near}, {1.0 - 2.0 * near, near},
                                         {near, 1.0 - 2.0 * near}, {far, far},   {1.0 - 2.0 * far, far},
                                         {far, 1.0 - 2.0 * far}};
    constexpr double slope[2][3] = {{-1.0, 1.0, 0.0}, {-1.0, 0.0, 1.0}};
    for (int q = 0; q < points; ++q) {
      weight[q] = q == 0 ? 9.0 / 40.0 : (155.0 + (q < 4 ? -root : root)) / 1200.0;
      const double lambda[3] = {1.0 - place[q][0] - place[q][1], place[q][0], place[q][1]};
      fill(lambda, slope[0], q, along_u);
      fill(lambda, slope[1], q, along_v);
    }
  }

 private:
  /// Shape functions at lambda, and their derivatives along the direction in which lambda changes by change_of.
  constexpr void fill(const double* lambda, const double* change_of, int q, double (*slope)[8]) {
    const double bubble = 27.0 * lambda[0] * lambda[1] * lambda[2];
    const double change = 27.0 * (change_of[0] * lambda[1] * lambda[2] + lambda[0] * change_of[1] * lambda[2] +
                                  lambda[0] * lambda[1] * change_of[2]);
    for (int n = 0; n < 3; ++n) {
      const int m = (n + 1) % 3;
      value[n][q] = lambda[n] * (2.0 * lambda[n] - 1.0) + bubble / 9.0;
      slope[n][q] = (4.0 * lambda[n] - 1.0) * change_of[n] + change / 9.0;
      value[3 + n][q] = 4.0 * lambda[n] * lambda[m] - bubble * 4.0 / 9.0;
      slope[3 + n][q] = 4.0 * (lambda[n] * change_of[m] + change_of[n] * lambda[m]) - change * 4.0 / 9.0;
    }
    value[6][q] = bubble;
    slope[6][q] = change;
  }
};

/// Triangle of seven points: quadratic, and the cubic that vanishes on the sides. Its volume and area are wrong by the
/// integral of a cubic error, and the rule on these points (1/20 the corners, 2/15 the sides, 9/20 the middle)
/// integrates cubics exactly: the error is O(h^4) on triangles of any shape. Six points alone leave a cubic error in
/// every triangle, most of which cancels between them: measured on ellipsoids, four times the error.
template <>
struct CurvedElement<3> {
  static constexpr int sides = 3;
  /// Points that span an element: its corners, one above each side, one above the middle.
  using Nodes = std::array<Vec<3>, 7>;
  static constexpr std::array<std::array<int, 2>, 3> side = {{{0, 1}, {1, 2}, {2, 0}}};

  static double add_gap(const Nodes& x, Moments<3>& gap) {
    Lanes y[3], u[3], v[3];
    for (int d = 0; d < 3; ++d) {
      y[d] = u[d] = v[d] = Lanes(0.0);
      for (int n = 1; n < 7; ++n) {
        const Lanes z(x[n][d] - x[0][d]);
        y[d] = fma(Lanes::load_aligned(table.value[n]), z, y[d]);
        u[d] = fma(Lanes::load_aligned(table.along_u[n]), z, u[d]);
        v[d] = fma(Lanes::load_aligned(table.along_v[n]), z, v[d]);
      }
    }
    const Lanes weight = Lanes::load_aligned(table.weight) * Lanes(0.5);
    Lanes square(0.0), flux(0.0);
    for (int d = 0; d < 3; ++d) {
      const int e = (d + 1) % 3, f = (d + 2) % 3;
      const Lanes normal = (u[e] * v[f] - u[f] * v[e]) * weight;
      square = fma(normal, normal, square);
      flux = fma(y[d], normal, flux);
    }
    // div y = 3 and div (y y_k) = 4 y_k; neither flows through the flat element or a strip with corner 0.
    Moments<3> body{sum(flux) / 3.0, {}};
    for (int d = 0; d < 3; ++d) body.first[d] = sum(flux * y[d]) / 4.0;
    add_strip(x, body);
    gap += body.moved(x[0]);
    return sum_of_roots(square);
  }
  /// Calls f(point, normal) for the points of the rule that integrates over the element, the normal being as long as
  /// the point's weight.
  template <class F>
  static void for_each_point(const Nodes& x, F&& f) {
    for (int q = 0; q < SevenNodeTriangle::points; ++q) {
      Vec<3> y, u, v;
      for (int n = 0; n < 7; ++n) {
        y += table.value[n][q] * x[n];
        u += table.along_u[n][q] * x[n];
        v += table.along_v[n][q] * x[n];
      }
      f(y, area_vector<3>({Vec<3>{}, u, v}) * table.weight[q]);
    }
  }

 private:
  using Lanes = simd::Pack<double, 8>;

  /// The strip above the side across from corner 0: a segment of a parabola as in 2D.
  static void add_strip(const Nodes& x, Moments<3>& body) {
    const Vec<3> a = x[1] - x[0], b = x[2] - x[0];
    const Vec<3> rise = x[4] - x[0] - (a + b) * 0.5;
    const double flux = -4.0 / 3.0 * dot(a, area_vector<3>({Vec<3>{}, rise, b - a}));
    body.volume += flux / 3.0;
    body.first += flux / 4.0 * ((a + b) * 0.5 + rise * 0.4);
  }
  static double sum_of_roots(const Lanes& square) {
    alignas(64) double value[8];
    square.store_aligned(value);
    double sum = 0.0;
    for (int q = 0; q < SevenNodeTriangle::points; ++q) sum += std::sqrt(value[q]);
    return sum;
  }

  static constexpr SevenNodeTriangle table{};
};

}  // namespace cambium::detail
