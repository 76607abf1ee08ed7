// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <type_traits>

#include <cambium/core/columns.hpp>
#include <cambium/core/error.hpp>
#include <cambium/core/lattice.hpp>
#include <cambium/simd/pack.hpp>

namespace cambium::detail {

/// How far particle i is from node i of a lattice, in spacings; on periodic axes the image that is closest to what all
/// displacements have in common.
template <class P, class T, int D>
class Displacements {
 public:
  Displacements(const Lattice<D>& lattice, Columns<D, const P> x) : per_spacing_(1.0 / lattice.spacing()) {
    for (int d = 0; d < D; ++d) {
      const double n = lattice.periodic(d) ? static_cast<double>(lattice.nodes()[d]) : 0.0;
      axis_[d] = {lattice.box().lo[d], n, n > 0.0 ? 1.0 / n : 0.0, n > 0.0 ? in_common(lattice, x, d) : 0.0};
    }
  }

  /// False if something is wrong with the positions, for certain.
  bool finite() const {
    return std::all_of(axis_.begin(), axis_.end(), [](const Axis& axis) { return std::isfinite(axis.common); });
  }

  /// Displacements along an axis of particles x[0], ..., x[count - 1] from nodes with these indices along it: `node`,
  /// or node, node + 1, ... along axis 0.
  ///
  /// Smooth displacements that reach around the period have particles within a spacing of half a period from the common
  /// displacement: neighbours would carry values a period apart, whose mean means nothing.
  /// \throws ValueError if there are such particles and the values are to be carried, i.e. but for the last axis
  void row(int axis, std::ptrdiff_t node, const P* x, std::size_t count, T* displacement) const {
    const Axis& on = axis_[axis];
    const V step(axis == 0 ? static_cast<double>(lanes) : 0.0);
    V nodes(static_cast<double>(node));
    if (axis == 0) nodes = nodes + V::load_aligned(ascending.data());
    const V lo(on.lo), per_spacing(per_spacing_), period(on.period), per_period(on.per_period);
    const V half(0.5 - on.common * on.per_period);
    V lowest(on.common), highest(on.common);
    const auto shortest = [&](const V& position) {
      const V u = (position - lo) * per_spacing - nodes;
      const V moved = u - period * floor(fma(u, per_period, half));
      lowest = min(lowest, moved);
      highest = max(highest, moved);
      return moved;
    };
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes, nodes = nodes + step) store(shortest(load(x + i)), displacement + i);
    if (i < count) {  // lanes beyond the end have no displacement but the common one
      alignas(64) std::array<double, lanes> at;
      for (std::size_t l = 0; l < lanes; ++l) {
        const double index = static_cast<double>(node) + (axis == 0 ? static_cast<double>(i + l) : 0.0);
        at[l] = i + l < count ? static_cast<double>(x[i + l]) : on.lo + (index + on.common) / per_spacing_;
      }
      shortest(V::load_aligned(at.data())).store_aligned(at.data());
      for (std::size_t l = 0; i + l < count; ++l) displacement[i + l] = static_cast<T>(at[l]);
    }
    if (axis == D - 1 || on.period == 0.0) return;
    const double furthest = std::max(on.common - lowest_lane(lowest), -lowest_lane(V(on.common) - highest));
    if (furthest <= 0.5 * on.period - 1.0) return;
    throw ValueError(message("split remeshing: particles have moved along axis ", axis, " by up to ", furthest,
                             " spacings against one another, which reaches around the period of ", on.period,
                             ": remesh after a shorter step, or use the strategy Tensor"));
  }

 private:
  static constexpr std::size_t lanes = simd::native_lanes<double>;
  using V = simd::Pack<double, lanes>;
  alignas(64) static constexpr auto ascending = [] {
    std::array<double, lanes> lane{};
    for (std::size_t l = 0; l < lanes; ++l) lane[l] = static_cast<double>(l);
    return lane;
  }();
  struct Axis {
    double lo, period, per_period, common;
  };

  /// What displacements along a periodic axis have in common, in spacings: their circular mean over a sample.
  static double in_common(const Lattice<D>& lattice, Columns<D, const P> x, int axis) {
    const double radians = 2.0 * std::numbers::pi / static_cast<double>(lattice.nodes()[axis]);
    double cosines = 0.0, sines = 0.0;
    for (std::size_t p = 0; p < x.size(); p += x.size() / 1024 + 1) {
      const double moved = static_cast<double>(x.column(axis)[p]) - lattice.position(lattice.node(p))[axis];
      cosines += std::cos(radians * moved / lattice.spacing());
      sines += std::sin(radians * moved / lattice.spacing());
    }
    return std::atan2(sines, cosines) / radians;
  }
  static V load(const P* x) {
    if constexpr (std::is_same_v<P, double>) {
      return V::load(x);
    } else {
      alignas(64) std::array<double, lanes> at;
      for (std::size_t l = 0; l < lanes; ++l) at[l] = static_cast<double>(x[l]);
      return V::load_aligned(at.data());
    }
  }
  static void store(const V& moved, T* displacement) {
    if constexpr (std::is_same_v<T, double>) {
      moved.store(displacement);
    } else {
      alignas(64) std::array<double, lanes> at;
      moved.store_aligned(at.data());
      for (std::size_t l = 0; l < lanes; ++l) displacement[l] = static_cast<T>(at[l]);
    }
  }

  double per_spacing_;
  std::array<Axis, D> axis_{};
};

}  // namespace cambium::detail
