// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include <cambium/levelset/advection/mover.hpp>
#include <cambium/levelset/advection/velocity.hpp>
#include <cambium/surface/point_reader.hpp>
#include <cambium/surface/surface_band.hpp>
#include <cambium/time/rk4.hpp>

namespace cambium {

/// Carries species from an interface to where it has moved to:
///   dc/dt + c div_s u = 0 along the paths dx/dt = u
/// (Bergdorf, Milde & Koumoutsakos, eq. 11.40 without reaction and diffusion), for any length of a step.
///
/// Particles on the new interface are traced back to the old one, c is read there and multiplied by the ratio of the
/// elements of area, dS_old / dS_new, that the map of the particles itself has: the surface divergence is never
/// differenced in time, rigid motions have the ratio 1, and what a piece of the interface carries is conserved to the
/// order of the interpolation. Errors of one step: O(h^4) or O(h^6) of reading c (SurfaceLaplacian<2>, <4>), and O(h^3)
/// or O(h^5) times the way travelled of the ratio.
/// \tparam S  stepper along the paths
template <class Stencil = SurfaceLaplacian<2>, int D = 3, class T = double, template <class, class> class S = RK4>
class SurfaceTransport {
 public:
  using Band = SurfaceBand<Stencil, D, T>;

  struct Params {
    /// Steps of the stepper for every call.
    int substeps = 1;
    /// Whether c is a concentration that a growing interface dilutes, or a value that particles keep.
    bool conserved = true;
  };

  /// \throws ValueError for options out of range
  explicit SurfaceTransport(const Params& params = {}) : params_(params) {
    if (params.substeps < 1) {
      throw ValueError(detail::message("surface transport with ", params.substeps, " substeps: at least 1 is needed"));
    }
  }

  /// to := the species `from` of `before`, the interface at t, carried to `after`, the interface at t + dt, by
  /// velocity(Vec<D, T> x, double time) -> Vec<D, T>, called by several threads.
  /// \param from, to  arrays of before.size() and after.size() numbers, or Columns of them
  /// \throws BandError if a path from the new interface does not lead to the old one: the two, or the velocity, are not
  ///         of one motion; ValueError for a dt that is not positive and finite
  template <class From, class V, class To, Execution E = OpenMP>
  void operator()(const Band& before, const From& from, V&& velocity, double t, double dt, const Band& after, To&& to,
                  const E& execution = {}) {
    detail::check_velocity<V, T, D>();
    detail::require_step(t, dt);
    const auto source = read_columns(from);
    const auto target = detail::columns_of(to);
    static_assert(source.count == target.count, "cambium: arrays of a surface band have the same number of species");
    require_size(source.size(), before.size(), "the array of the surface band before the step");
    require_size(target.size(), after.size(), "the array of the surface band after the step");
    trace_back(after, velocity, t, dt, execution);
    find_ratios(after, execution);
    read(before, source, after, target, execution);
  }

 private:
  static Columns<D, T> columns(std::array<AlignedVector<T>, D>& arrays) {
    std::array<T*, D> first;
    for (int d = 0; d < D; ++d) first[d] = arrays[d].data();
    return {first, arrays[0].size()};
  }
  /// moved := displacements from the new interface back to the old one.
  template <class V, class E>
  void trace_back(const Band& after, V&& velocity, double t, double dt, const E& execution) {
    for (auto* arrays : {&start_, &moved_}) {
      for (auto& column : *arrays) column.resize(after.size());
    }
    const auto start = columns(start_), moved = columns(moved_);
    for_each(execution, after.size(), [&](std::size_t k) {
      const Vec<D> x = after.point(k);
      for (int d = 0; d < D; ++d) start_[d][k] = moved_[d][k] = static_cast<T>(x[d]);
    });
    move_(
        moved, [](std::size_t) { return T(1); },
        [&](const Vec<D, T>& x, double s) { return -Vec<D, T>(velocity(x, t + dt - s)); }, 0.0, dt, params_.substeps,
        execution);
    const T scale = static_cast<T>(1.0 / after.spacing());
    for_each(execution, after.size(), [&](std::size_t k) { moved.set(k, (moved[k] - start[k]) * scale); });
  }
  /// ratio := |F t_1 x F t_2|, F = 1 + gradient of the displacement, t_i unit tangents; |F t| in 2D.
  template <class E>
  void find_ratios(const Band& after, const E& execution) {
    ratio_.assign(after.size(), T(1));
    if (!params_.conserved) return;
    const auto& plan = after.plan();
    fit(plan, D, execution);
    for_each_piece_by_worker(execution, plan.groups.size(), 1, [&](std::size_t w, std::size_t g, std::size_t) {
      const auto& group = plan.groups[g];
      auto& values = values_[w];
      for (int d = 0; d < D; ++d) values.read(plan, group, moved_[d].data(), d);
      for (std::size_t k = group.first_value; k < group.first_value + group.values; ++k) {
        Index<D> cell;
        Vec<D, T> inside = plan.of(plan.place, k);
        for (int d = 0; d < D; ++d) {
          cell[d] = static_cast<std::ptrdiff_t>(inside[d]);
          inside[d] -= static_cast<T>(cell[d]);
        }
        const typename detail::PointReader<Stencil, T, D>::Cell stencil(cell, inside, values.stride_of(group));
        std::array<Vec<D, T>, D> slope;
        for (int d = 0; d < D; ++d) slope[d] = stencil.gradient(values.patch(d));
        ratio_[k] = ratio(slope, after.normal(k));
      }
    });
  }
  static T ratio(const std::array<Vec<D, T>, D>& slope, const Vec<D, T>& n) {
    const auto carried = [&](const Vec<D, T>& tangent) {
      Vec<D, T> result = tangent;
      for (int d = 0; d < D; ++d) result[d] += dot(slope[d], tangent);
      return result;
    };
    if constexpr (D == 2) {
      return norm(carried({-n[1], n[0]}));
    } else {
      const int least = std::abs(n[0]) < T(0.6) ? 0 : 1;
      Vec<3, T> a = Vec<3, T>::unit(least) - n[least] * n;
      a /= norm(a);
      const Vec<3, T> u = carried(a), v = carried(cross(n, a));
      return norm(cross(u, v));
    }
  }
  template <class From, class To, class E>
  void read(const Band& before, const From& from, const Band& after, const To& to, const E& execution) {
    const auto& plan = before.plan();
    fit(plan, from.count, execution);
    reader_.locate(
        plan, after.size(),
        [&](std::size_t k) {
          Vec<D> place;
          for (int d = 0; d < D; ++d) {
            const double start = (static_cast<double>(start_[d][k]) - after.lattice().box().lo[d]) / after.spacing();
            place[d] = start + static_cast<double>(moved_[d][k]);
          }
          return place;
        },
        [&](std::size_t k) {
          Vec<D> normal;
          for (int d = 0; d < D; ++d) normal[d] = static_cast<double>(after.normal(k)[d]);
          return normal;
        },
        execution);
    reader_.for_each_group(execution, [&](std::size_t w, std::size_t g, std::size_t begin, std::size_t end) {
      auto& values = values_[w];
      for (int s = 0; s < from.count; ++s) values.read(plan, plan.groups[g], from.column(s).data(), s);
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t k = reader_.order(i);
        const auto stencil = reader_.stencil(plan, k);
        for (int s = 0; s < from.count; ++s) to.column(s)[k] = ratio_[k] * stencil.value(values.patch(s));
      }
    });
  }
  template <class E>
  void fit(const detail::SheetPlan<T, D>& plan, int fields, const E& execution) {
    values_.resize(std::max(values_.size(), static_cast<std::size_t>(execution.count())));
    for (auto& values : values_) values.fit(plan, fields);
  }

  Params params_;
  detail::Mover<T, D, S> move_;
  std::array<AlignedVector<T>, D> start_, moved_;  ///< positions; displacements in spacings
  AlignedVector<T> ratio_;
  detail::PointReader<Stencil, T, D> reader_;
  std::vector<detail::GroupValues<Stencil, T, D>> values_;
};

}  // namespace cambium
