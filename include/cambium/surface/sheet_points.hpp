// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include <cambium/kernels/hat.hpp>
#include <cambium/kernels/lambda.hpp>
#include <cambium/levelset/closest_points.hpp>
#include <cambium/levelset/patch.hpp>

namespace cambium::detail {

/// A point of the interface with its outward normal, in spacings.
template <class T, int D>
struct SheetPoint {
  Vec<D, T> point;
  Vec<D, T> normal;

  /// True if another point near it is on the same sheet of the interface: normals differ by less than a right angle,
  /// and the other is as near to the tangent plane as it is on surfaces with radii of curvature of four spacings.
  /// Sheets that face each other have opposite normals; those that do not have another one between them.
  bool same_sheet(const SheetPoint& other) const {
    const Vec<D, T> between = other.point - point;
    return dot(normal, other.normal) > T(0) && std::abs(dot(between, normal)) <= T(1) + T(0.5) * norm(between);
  }
};

/// Closest points of nodes: the nearest of all, or the nearest on a given sheet.
template <class K, class T, int D>
class SheetPoints {
 public:
  using Band = NarrowBand<T, D>;
  using Point = SheetPoint<T, D>;

  SheetPoints(const Band& band, const ClosestPoints<K, T, D>& points) : band_(band), points_(points) {}

  /// The closest point of node i of block b; points relative to the node. The normal is the way to the node or, where
  /// that is short, that of the interpolant of phi.
  Point nearest(std::size_t b, std::size_t i) {
    const Vec<D, T> offset = points_.offset(b, i);
    const T length = norm(offset);
    const T phi = band_.values().block(b)[i];
    if (length > T(0.3)) return {offset, offset * ((phi < T(0) ? T(1) : T(-1)) / length)};
    if (in_patch_ != b) patch_.read_block(band_, b, halo);
    in_patch_ = b;
    const Vec<D, T> y = patch_.position(patch_.entry(i)) + offset;
    const Jet<T, D> jet = Interpolant<K, T, D>::jet(patch_.data(), patch_.stride(), y);
    const T slope = norm(jet.gradient);
    return {offset, slope > T(0) ? jet.gradient / slope : Vec<D, T>::unit(0)};
  }
  /// The same for a node of the lattice, if it has one.
  std::optional<Point> nearest(const Index<D>& node) {
    const std::ptrdiff_t b = band_.values().find(Band_::block_of(node));
    if (b < 0 || !points_.found(static_cast<std::size_t>(b), Band_::offset(node))) return std::nullopt;
    return nearest(static_cast<std::size_t>(b), Band_::offset(node));
  }
  /// The closest point of a node on the sheet of a point that is given relative to the node; searched from the foot of
  /// the node on the tangent plane there. None if the search leaves the sheet, as behind a focal point.
  std::optional<Point> on_sheet(const Index<D>& node, const Point& sheet) {
    const Vec<D, T> foot = sheet.normal * dot(sheet.point, sheet.normal);
    if (const auto found = search<K>(node, foot, sheet)) return found;
    return search<Hat>(node, foot, sheet);
  }

 private:
  using Band_ = Field<T, D, Sparse>;
  static constexpr std::ptrdiff_t halo = K::support / 2 + 2;
  static constexpr auto none = static_cast<std::size_t>(-1);

  template <class Kernel>
  std::optional<Point> search(const Index<D>& node, const Vec<D, T>& foot, const Point& sheet) {
    Index<D> first;
    Vec<D, T> x;
    for (int d = 0; d < D; ++d) {
      const auto cell = static_cast<std::ptrdiff_t>(std::floor(foot[d]));
      first[d] = node[d] + cell - halo;
      x[d] = static_cast<T>(halo - cell);
    }
    in_patch_ = none;
    patch_.read(band_, first, Index<D>::constant(2 * halo + 2));
    ClosestPointSearch<Kernel, T, D> newton(patch_, norm(foot) + T(3));
    Vec<D, T> y = x + foot;
    if (!newton(x, y)) return std::nullopt;
    const T slope = norm(newton.jet().gradient);
    if (!(slope > T(0))) return std::nullopt;
    const Point found{y - x, newton.jet().gradient / slope};
    return sheet.same_sheet(found) ? std::optional<Point>(found) : std::nullopt;
  }

  const Band& band_;
  const ClosestPoints<K, T, D>& points_;
  Patch<T, D> patch_;
  std::size_t in_patch_ = none;  ///< the block that was read last
};

}  // namespace cambium::detail
