// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <cambium/levelset/closest_point_step.hpp>
#include <cambium/levelset/reinit/cell_polynomial.hpp>
#include <cambium/levelset/reinit/crossed_nodes.hpp>
#include <cambium/levelset/reinit/kick_off.hpp>

namespace cambium {

namespace detail {

/// The closest point y on the zero set of the polynomials of the cells: by Chopp's steps, to the tangent plane and
/// along it (Chopp 2001, eq. 3.2), which converge fast where the interface is resolved, then by Newton's method for y -
/// x + mu grad p = 0, p = 0, which needs second derivatives but converges fast everywhere.
///
/// The cell is kept until y is `slack` outside of it, so that the small steps between the polynomials of two cells
/// cannot send the search to and fro.
template <class T, int D, int N>
class CellSearch {
 public:
  /// How far y may be from x along each axis: the patch must hold reach + 1 nodes around x.
  static constexpr std::ptrdiff_t reach = 2;

  /// \param x  position of a node in the patch
  /// \param y  first guess; the closest point if it is found, else unchanged. \return whether it is
  static bool run(const Patch<T, D>& patch, const Vec<D, T>& x, Vec<D, T>& y) {
    Vec<D, T> at = y;
    Vec<D, T> low;
    if (!enter(x, at, low)) return false;
    CellPolynomial<T, D, N> cell(patch, low);
    T mu(0);
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      const bool of_first_order = iteration < first_order_iterations;
      const Jet<T, D> jet = of_first_order ? cell.template jet<1>(at - low) : cell.template jet<2>(at - low);
      const T slope = dot(jet.gradient, jet.gradient);
      if (!(slope > T(0))) return false;
      if (iteration == first_order_iterations) mu = dot(x - at, jet.gradient) / slope;
      Vec<D, T> step = of_first_order ? tangent_step(jet, x - at) : closest_point_step(jet, x - at, mu);
      const T length = norm(step);
      if (length > longest_step) step *= longest_step / length;
      at += step;
      if (left(at, low)) {
        if (!enter(x, at, low)) return false;
        cell = CellPolynomial<T, D, N>(patch, low);
      } else if (length < tolerance) {
        y = at;
        return true;
      }
    }
    return false;
  }

 private:
  static constexpr int first_order_iterations = 4;
  static constexpr int most_iterations = 20;
  static constexpr T longest_step = T(0.5);
  static constexpr T slack = T(0.25);
  /// The distance is then off by about its square over the radius of curvature.
  static constexpr T tolerance = sizeof(T) == 8 ? T(5e-4) : T(2e-3);

  /// The cell of y. \return false if that is out of reach
  static bool enter(const Vec<D, T>& x, const Vec<D, T>& y, Vec<D, T>& low) {
    for (int d = 0; d < D; ++d) {
      if (!(std::abs(y[d] - x[d]) < static_cast<T>(reach))) return false;
      low[d] = std::floor(y[d]);
    }
    return true;
  }
  static bool left(const Vec<D, T>& y, const Vec<D, T>& low) {
    for (int d = 0; d < D; ++d) {
      const T u = y[d] - low[d];
      if (!(u > -slack && u < T(1) + slack)) return true;
    }
    return false;
  }
};

}  // namespace detail

/// Kick-off by closest points on bicubic or tricubic patches (Chopp 2001, "Some improvements of the fast marching
/// method"): all corners of the cells that the interface crosses get their distances, of fourth order.
///
/// Other than in the paper the cubic runs through the 4^D nodes around a cell instead of taking central differences as
/// derivatives at its corners (the same nodes, one order more), and the point is found by Newton's method proper. Where
/// that fails, the cell is bilinear or trilinear; where that fails too, a node next to a crossing takes the linear
/// estimate, and the other corners are left to what follows.
struct ChoppKickOff {
  struct Params {};

  template <class T, int D>
  class Method {
   public:
    Method() = default;
    explicit Method(const Params&) {}

    /// Distances of the corners of crossed cells.
    template <Execution E>
    KickOffCounts operator()(const NarrowBand<T, D>& band, std::span<T> distance, const E& execution) {
      patches_.resize(static_cast<std::size_t>(execution.count()));
      counts_.assign(band.blocks(), {});
      signs_.find(band, execution);
      for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
        detail::CrossedNodes<T, D> crossed;
        if (!crossed.template find<detail::Beside::cell>(band, signs_, b)) return;
        Patch<T, D>& patch = patches_[worker];
        patch.read_block(band, b, halo);
        crossed.for_each([&](std::size_t i) {
          const T found = find(patch, i, counts_[b]);
          // What is not found stays as it is: the NaN there knows the side of the node.
          if (!std::isnan(found)) distance[b * NarrowBand<T, D>::volume + i] = found;
        });
      });
      KickOffCounts total;
      for (const KickOffCounts& counts : counts_) {
        total.nodes += counts.nodes;
        total.lower_order += counts.lower_order;
        total.estimated += counts.estimated;
      }
      return total;
    }

   private:
    template <int N>
    using Search = detail::CellSearch<T, D, N>;
    static constexpr std::ptrdiff_t halo = Search<4>::reach + 1;
    /// How much further than the linear estimate a closest point may be.
    static constexpr T slack = T(0.5);

    static T find(const Patch<T, D>& patch, std::size_t i, KickOffCounts& counts) {
      const std::ptrdiff_t at = patch.entry(i);
      Vec<D, T> x;
      for (int d = 0; d < D; ++d, i /= NarrowBand<T, D>::extent) {
        x[d] = static_cast<T>(static_cast<std::ptrdiff_t>(i % NarrowBand<T, D>::extent) + halo);
      }
      Vec<D, T> offset;
      const bool crossed = estimate(patch, at, offset);
      const T longest = crossed ? norm(offset) + slack : diagonal + slack;
      Vec<D, T> y = x + offset;
      if (!(Search<4>::run(patch, x, y) && norm(y - x) < longest)) {
        y = x + offset;
        if (Search<2>::run(patch, x, y) && norm(y - x) < longest) {
          ++counts.lower_order;
        } else {
          y = x + offset;
          ++counts.estimated;
          if (!crossed) return std::copysign(std::numeric_limits<T>::quiet_NaN(), patch[at] < T(0) ? T(-1) : T(1));
        }
      }
      ++counts.nodes;
      return detail::on_side_of(patch[at], norm(y - x));
    }
    /// From a node to the plane through the crossings of the lattice lines through it; where none is crossed, to the
    /// tangent plane. \return true if a line is crossed
    static bool estimate(const Patch<T, D>& patch, std::ptrdiff_t at, Vec<D, T>& offset) {
      offset = {};
      if (patch[at] == T(0)) return true;
      Vec<D, T> inverse;
      const bool crossed = detail::inverse_crossings(patch, at, inverse);
      if (!crossed) {
        for (int d = 0; d < D; ++d) {
          inverse[d] = (patch[at - patch.stride()[d]] - patch[at + patch.stride()[d]]) / (T(2) * patch[at]);
        }
      }
      const T square = dot(inverse, inverse);
      if (square > T(0) && square < std::numeric_limits<T>::max()) {
        offset = inverse / std::max(square, std::sqrt(square) / diagonal);
      }
      return crossed;
    }
    /// Length of the diagonal of a cell.
    static constexpr T diagonal = static_cast<T>(D == 2 ? std::numbers::sqrt2 : std::numbers::sqrt3);

    detail::SignRows<T, D> signs_;
    std::vector<Patch<T, D>> patches_;
    std::vector<KickOffCounts> counts_;
  };
};

}  // namespace cambium
