// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include <cambium/interface/cut_domain.hpp>
#include <cambium/interface/fitted_gradient.hpp>
#include <cambium/interface/side.hpp>
#include <cambium/levelset/closest_point_walk.hpp>
#include <cambium/levelset/geometry/surface_geometry.hpp>

namespace cambium {

/// How slopes at an interface are taken from values beside it.
enum class SlopeStencil {
  cubic,       ///< of cubic polynomials: the more accurate ones for smooth values
  differences  ///< of centred differences, second order: those of noise from node to node keep the right sign
};

namespace detail {

/// Derivatives along the normal, at closest points, of values that were continued beyond the interface: of the product
/// of cubic polynomials through the 4^D nodes around a point; where one of them has no value, or is beyond a wall, of
/// centred differences at the corners of its cell, interpolated linearly; where these lack one, too (thin parts, sharp
/// tips), or one would be `between` two fronts, of a fit to the values on the point's own side (see FittedGradient).
template <int D>
class InterfaceGradient {
 public:
  /// Nodes beyond the interface that the differences need, along an axis.
  static constexpr std::ptrdiff_t reach = D + 2;

  /// \param domain  with nodes beyond the interface marked as `continued`, \param x  values at its entries
  /// \param data    values on the interface, of the legs of the cut nodes
  template <class K, class B, Execution E>
  void differentiate(const NarrowBand<B, D>& band, const ClosestPoints<K, B, D>& points, const CutDomain<D>& domain,
                     const double* x, const std::vector<double>& data, Side side, SlopeStencil slopes,
                     Field<B, D, Sparse>& derivative, const E& execution) {
    workers_.resize(static_cast<std::size_t>(execution.count()));
    fits_.resize(workers_.size());
    auto& patches = std::get<std::vector<Patch<B, D>>>(patches_);
    patches.resize(workers_.size());
    for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
      const auto values = derivative.block(b);
      if (!read_values(points, band, b, domain, x, workers_[worker])) {
        std::fill(values.begin(), values.end(), B(0));
        return;
      }
      Normals<K, B> normals{points, band, b, patches[worker]};
      for (std::size_t i = 0; i < NarrowBand<B, D>::volume; ++i) {
        values[i] = B(0);
        if (!points.found(b, i)) continue;
        const Vec<D, B> n = normals(i);
        const Vec<D> place = place_of(points, band, b, i);
        Vec<D> gradient = gradient_at(place, domain, workers_[worker], slopes);
        if (is_missing(gradient)) {
          Vec<D> outward;
          for (int d = 0; d < D; ++d) outward[d] = (side == Side::inside ? 1.0 : -1.0) * static_cast<double>(n[d]);
          gradient = fits_[worker](place, outward, domain, x, data, slopes == SlopeStencil::cubic);
        }
        double along = 0.0;
        for (int d = 0; d < D; ++d) along += gradient[d] * static_cast<double>(n[d]);
        values[i] = static_cast<B>(along / band.spacing());
      }
    });
  }

 private:
  /// Copy of a box of values, not a number where there is none.
  struct Box {
    Index<D> first, stride;
    std::vector<double> values;
  };

  /// Unit normals at the closest points of a block: the direction of the node where it is far enough, and the gradient
  /// of the interpolant of K elsewhere and where no search converged.
  template <class K, class B>
  struct Normals {
    static constexpr B far = B(1);          ///< spacings: closest points are good to 1e-7 (double) or 1e-4 (float)
    static constexpr B converged = B(0.1);  ///< error of points that a search found

    const ClosestPoints<K, B, D>& points;
    const NarrowBand<B, D>& band;
    std::size_t b;
    Patch<B, D>& patch;
    PointBox<K, B, D> box{};

    Vec<D, B> operator()(std::size_t i) {
      const Vec<D, B> offset = points.offset(b, i);
      if (is_far(i)) {
        const B length = norm(offset);
        return offset * ((band.values().block(b)[i] < B(0) ? B(1) : B(-1)) / length);
      }
      if (box.empty()) read();
      const Vec<D, B> u = position_in_block<B, D>(i) + offset - box.corner();
      return surface_geometry(Interpolant<K, B, D>::jet(patch.data(), patch.stride(), u), B(1)).normal;
    }
    bool is_far(std::size_t i) const {
      const Vec<D, B> offset = points.offset(b, i);
      return dot(offset, offset) >= far * far && points.error(b, i) < converged;
    }
    void read() {
      for (std::size_t i = 0; i < NarrowBand<B, D>::volume; ++i) {
        if (points.found(b, i) && !is_far(i)) box.add(position_in_block<B, D>(i) + points.offset(b, i));
      }
      box.read(band, band.values().block_origin(b), 0, patch);
    }
  };

  /// In spacings from the first node of the lattice.
  template <class K, class B>
  static Vec<D> place_of(const ClosestPoints<K, B, D>& points, const NarrowBand<B, D>& band, std::size_t b,
                         std::size_t i) {
    const Index<D> origin = band.values().block_origin(b);
    const Vec<D, B> in_block = position_in_block<B, D>(i);
    const Vec<D, B> offset = points.offset(b, i);
    Vec<D> place;
    for (int d = 0; d < D; ++d) {
      place[d] = static_cast<double>(origin[d]) + static_cast<double>(in_block[d]) + static_cast<double>(offset[d]);
    }
    return place;
  }

  /// Copies the values that the points of a block need. \return false if it has no points
  template <class K, class B>
  static bool read_values(const ClosestPoints<K, B, D>& points, const NarrowBand<B, D>& band, std::size_t b,
                          const CutDomain<D>& domain, const double* x, Box& box) {
    Index<D> low = Index<D>::constant(std::numeric_limits<std::ptrdiff_t>::max());
    Index<D> high = Index<D>::constant(std::numeric_limits<std::ptrdiff_t>::lowest());
    bool any = false;
    for (std::size_t i = 0; i < NarrowBand<B, D>::volume; ++i) {
      if (!points.found(b, i)) continue;
      any = true;
      const Vec<D> place = place_of(points, band, b, i);
      for (int d = 0; d < D; ++d) {
        const auto cell = static_cast<std::ptrdiff_t>(std::floor(place[d]));
        low[d] = std::min(low[d], cell - 1);
        high[d] = std::max(high[d], cell + 2);
      }
    }
    if (any) copy(domain, x, low, high, box);
    return any;
  }
  static void copy(const CutDomain<D>& domain, const double* x, const Index<D>& low, const Index<D>& high, Box& box) {
    const LevelGrid<D>& grid = domain.grid;
    box.first = low;
    std::ptrdiff_t size = 1;
    for (int d = 0; d < D; ++d) {
      box.stride[d] = size;
      size *= high[d] - low[d] + 1;
    }
    if (box.values.size() < static_cast<std::size_t>(size)) box.values.resize(static_cast<std::size_t>(size));
    double* to = box.values.data();
    const bool inner = low[0] >= 0 && high[0] < grid.nodes[0];
    for_each_row<D>(low, high, [&](const Index<D>& row) {
      Index<D> node = row;
      for (int d = 1; d < D; ++d) node[d] = continued_index(grid, d, row[d]);
      node[0] = 0;
      const auto start = static_cast<std::ptrdiff_t>(grid.at(node));
      for (std::ptrdiff_t i = low[0]; i <= high[0]; ++i) {
        const auto at = static_cast<std::size_t>(start + (inner ? i : continued_index(grid, 0, i)));
        *to++ =
            domain.kind[at] == beyond || domain.kind[at] == between ? std::numeric_limits<double>::quiet_NaN() : x[at];
      }
    });
  }
  /// The node whose value continues those of a line: periodic axes wrap, others mirror.
  static std::ptrdiff_t continued_index(const LevelGrid<D>& grid, int d, std::ptrdiff_t i) {
    const std::ptrdiff_t n = grid.nodes[d];
    if (grid.periodic[d]) return (i % n + n) % n;
    if (n == 1) return 0;
    i = i < 0 ? -i : i;
    return i > n - 1 ? 2 * (n - 1) - i : i;
  }

  /// Times the spacing.
  static Vec<D> gradient_at(const Vec<D>& place, const CutDomain<D>& domain, const Box& box, SlopeStencil slopes) {
    if (slopes == SlopeStencil::differences) return of_differences(place, box);
    const Vec<D> gradient = of_cubics(place, domain.grid, box);
    return is_missing(gradient) ? of_differences(place, box) : gradient;
  }
  static bool is_missing(const Vec<D>& gradient) {
    for (int d = 0; d < D; ++d) {
      if (std::isnan(gradient[d])) return true;
    }
    return false;
  }
  /// Not a number where a value is missing.
  static Vec<D> of_cubics(const Vec<D>& place, const LevelGrid<D>& grid, const Box& box) {
    std::array<std::array<double, 4>, D> value, slope;
    std::ptrdiff_t start = 0;
    for (int d = 0; d < D; ++d) {
      const auto first = static_cast<std::ptrdiff_t>(std::floor(place[d])) - 1;
      if (!grid.periodic[d] && (first < 0 || first + 3 >= grid.nodes[d])) {
        return Vec<D>::constant(std::numeric_limits<double>::quiet_NaN());
      }
      const auto axis = static_cast<std::size_t>(d);
      cubic_weights(place[d] - static_cast<double>(first + 1), value[axis], slope[axis]);
      start += (first - box.first[d]) * box.stride[d];
    }
    Vec<D> gradient;
    for (std::size_t k = 0; k < std::size_t{1} << (2 * (D - 1)); ++k) {
      std::ptrdiff_t row = start;
      std::array<double, D> weight;
      weight.fill(1.0);
      for (int d = 1; d < D; ++d) {
        const auto axis = static_cast<std::size_t>(d);
        const std::size_t step = k >> (2 * (axis - 1)) & 3;
        row += static_cast<std::ptrdiff_t>(step) * box.stride[d];
        for (std::size_t e = 0; e < D; ++e) weight[e] *= (e == axis ? slope : value)[axis][step];
      }
      double sum = 0.0, change = 0.0;
      for (std::size_t i = 0; i < 4; ++i) {
        const double at = box.values[static_cast<std::size_t>(row) + i];
        sum += value[0][i] * at;
        change += slope[0][i] * at;
      }
      for (int d = 0; d < D; ++d) gradient[d] += weight[static_cast<std::size_t>(d)] * (d == 0 ? change : sum);
    }
    return gradient;
  }
  /// Those of the values at -1, 0, 1, 2 in the cubic polynomial through them at t, and in its derivative.
  static void cubic_weights(double t, std::array<double, 4>& value, std::array<double, 4>& slope) {
    value = {-t * (t - 1.0) * (t - 2.0) / 6.0, (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
             -(t + 1.0) * t * (t - 2.0) / 2.0, (t + 1.0) * t * (t - 1.0) / 6.0};
    slope = {-(3.0 * t * t - 6.0 * t + 2.0) / 6.0, (3.0 * t * t - 4.0 * t - 1.0) / 2.0,
             -(3.0 * t * t - 2.0 * t - 2.0) / 2.0, (3.0 * t * t - 1.0) / 6.0};
  }
  /// Not a number where a value is missing.
  static Vec<D> of_differences(const Vec<D>& place, const Box& box) {
    Vec<D> gradient, part;
    std::ptrdiff_t start = 0;
    for (int d = 0; d < D; ++d) {
      const double cell = std::floor(place[d]);
      part[d] = place[d] - cell;
      start += (static_cast<std::ptrdiff_t>(cell) - box.first[d]) * box.stride[d];
    }
    for (int corner = 0; corner < 1 << D; ++corner) {
      std::ptrdiff_t at = start;
      double weight = 0.5;
      for (int d = 0; d < D; ++d) {
        const bool upper = (corner >> d) % 2 != 0;
        at += upper ? box.stride[d] : 0;
        weight *= upper ? part[d] : 1.0 - part[d];
      }
      if (weight == 0.0) continue;
      const double* const value = box.values.data() + at;
      for (int d = 0; d < D; ++d) gradient[d] += weight * (value[box.stride[d]] - value[-box.stride[d]]);
    }
    return gradient;
  }

  std::vector<Box> workers_;
  std::vector<FittedGradient<D>> fits_;
  std::tuple<std::vector<Patch<float, D>>, std::vector<Patch<double, D>>> patches_;
};

}  // namespace detail
}  // namespace cambium
