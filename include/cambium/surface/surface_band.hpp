// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <cambium/core/columns.hpp>
#include <cambium/levelset/closest_points.hpp>
#include <cambium/parallel/execution.hpp>
#include <cambium/surface/group_values.hpp>
#include <cambium/surface/sheet_builder.hpp>
#include <cambium/surface/surface_laplacian.hpp>
#include <cambium/surface/surface_stencil.hpp>

namespace cambium {

/// Functions on an interface, as values that are constant along its normals at the nodes around it, with surface
/// diffusion by the closest-point principle.
///
/// Values are flat arrays of size() numbers: one for every node and sheet of the interface that stencils read. A node
/// between two sheets that are near to each other has a value for each, so nothing leaks between them. Several species
/// are Columns, one array each. Nothing is allocated after fit() but when there are more species or threads than ever.
/// \tparam Stencil  SurfaceLaplacian<2> or <4>, see SurfaceStencil
template <class Stencil = SurfaceLaplacian<2>, int D = 3, class T = double>
class SurfaceBand {
  static_assert((check_surface_stencil<Stencil>(), true));

 public:
  static constexpr int dimension = D;
  using Scalar = T;

  struct Params {
    /// Rate times h^2 at which parts that vary along normals decay; 2 D as in von Glehn, Maerz & Macdonald (2013). It
    /// keeps the operator's spectrum in the left half-plane, so that implicit steps are stable.
    double penalty = 2.0 * D;
  };

  SurfaceBand() = default;
  /// \throws ValueError unless the penalty is positive and finite
  explicit SurfaceBand(const Params& params) : params_(params) {
    if (!(params.penalty > 0.0) || !std::isfinite(params.penalty)) {
      throw ValueError(detail::message("penalty of a surface band is ", params.penalty,
                                       " / h^2: it must be positive and finite; 2 D is the usual choice"));
    }
  }
  /// For the interface of a level set, see fit().
  template <class LevelSet>
  explicit SurfaceBand(const LevelSet& level_set, const Params& params = {}) : SurfaceBand(params) {
    fit(level_set);
  }

  /// Takes the interface of a level set: to be called when it has moved. All values are new then.
  /// \throws InterfaceError if stencils reach a bounded face; the band is then unchanged
  template <class LevelSet, Execution E = OpenMP>
  void fit(const LevelSet& level_set, const E& execution = {}) {
    if constexpr (requires { level_set.method().points(); }) {
      build(level_set.band(), level_set.method().points());
    } else {
      points_.find(level_set.band(), static_cast<double>(level_set.band().half_width()), execution);
      build(level_set.band(), points_);
    }
  }

  /// Number of values of each species.
  std::size_t size() const { return plan_.size(); }
  double spacing() const { return lattice_->spacing(); }
  const Lattice<D>& lattice() const { return *lattice_; }
  /// Node of value k, and its closest point, on periodic axes in the box.
  const Index<D>& node(std::size_t k) const { return plan_.node[k]; }
  Vec<D> point(std::size_t k) const {
    Vec<D> x = lattice_->position(plan_.node[k]);
    for (int d = 0; d < D; ++d) x[d] += static_cast<double>(plan_.offset[d][k]) * spacing();
    return lattice_->domain().wrap(x);
  }
  /// Outward unit normal at the closest point of value k.
  Vec<D, T> normal(std::size_t k) const { return plan_.of(plan_.normal, k); }
  /// Distance of node k from its closest point.
  double distance(std::size_t k) const { return static_cast<double>(norm(plan_.of(plan_.offset, k))) * spacing(); }
  /// Values on a sheet that is not the nearest to their node: above zero where sheets are near to each other.
  std::size_t second_sheets() const { return plan_.second_sheets; }
  /// Stencil nodes without a closest point on the sheet of the stencil, read from wherever they are nearest: zero where
  /// the radii of curvature are larger than the stencils.
  std::size_t folded() const { return plan_.folded; }
  const detail::SheetPlan<T, D>& plan() const { return plan_; }

  /// values[k] := f(closest point of k).
  template <class F, Execution E = OpenMP>
  void sample(F&& f, std::span<T> values, const E& execution = {}) const {
    require_size(values.size(), size(), "the array to sample");
    for_each(execution, size(), [&](std::size_t k) { values[k] = static_cast<T>(f(point(k))); });
  }
  /// to := `from` at the closest points: constant along normals, to the order of the interpolation.
  /// \param from, to  arrays of size() numbers, or Columns of them; not the same
  template <class From, class To, Execution E = OpenMP>
  void extend(const From& from, To&& to, const E& execution = {}) {
    run(from, to, execution, [&](auto& group_values, const auto& group, const T*, T* out) {
      group_values.interpolate_field(plan_, group, [&](std::size_t k, T value) { out[k] = value; });
    });
  }
  /// to := the surface Laplacian of `from`, constant along normals, minus penalty / h^2 times what `from` is off from
  /// its extension. Arguments as for extend().
  template <class From, class To, Execution E = OpenMP>
  void laplacian(const From& from, To&& to, const E& execution = {}) {
    const T penalty = static_cast<T>(params_.penalty);
    const T scale = static_cast<T>(1.0 / (spacing() * spacing()));
    run(from, to, execution, [&](auto& group_values, const auto& group, const T* in, T* out) {
      group_values.apply(group, penalty);
      group_values.interpolate_result(plan_, group,
                                      [&](std::size_t k, T value) { out[k] = scale * (value - penalty * in[k]); });
    });
  }
  /// Bound of the modulus of the eigenvalues of laplacian(), from power iterations, 5% on the safe side; found once for
  /// every fit(). Times the largest diffusivity it is what explicit steppers need.
  template <Execution E = OpenMP>
  double spectral_radius(const E& execution = {}) {
    if (radius_) return *radius_;
    AlignedVector<T> from(size()), to(size());
    for (std::size_t k = 0; k < size(); ++k) from[k] = T(0.5) + static_cast<T>(k * 2654435761U % 1024) / T(1024);
    for (std::size_t k = 1; k < size(); k += 2) from[k] = -from[k];
    double ratio = 0.0;
    for (int iteration = 0; iteration < power_iterations; ++iteration) {
      laplacian(from, to, execution);
      ratio = length(to, execution) / length(from, execution);
      const T factor = static_cast<T>(1.0 / length(to, execution));
      for_each(execution, size(), [&](std::size_t k) { from[k] = factor * to[k]; });
    }
    radius_ = 1.05 * ratio;
    return *radius_;
  }

 private:
  using K = Lambda<4, 4>;
  using Values = detail::GroupValues<Stencil, T, D>;
  static constexpr int power_iterations = 30;

  template <class Points>
  void build(const NarrowBand<T, D>& band, const Points& points) {
    auto builder = detail::SheetBuilder(std::type_identity<Stencil>{}, band, points);
    builder.write(plan_);
    lattice_ = band.lattice();
    radius_.reset();
  }
  template <class E>
  double length(const AlignedVector<T>& values, const E& execution) const {
    return std::sqrt(reduce(
        execution, values.size(), 0.0,
        [&](std::size_t k) { return static_cast<double>(values[k]) * static_cast<double>(values[k]); }, std::plus<>{}));
  }
  /// Calls f(patch, group, from, to) for all groups and species, the patch filled with the species.
  template <class From, class To, class E, class F>
  void run(const From& from, To& to, const E& execution, F&& f) {
    const auto source = read_columns(from);
    const auto target = detail::columns_of(to);
    static_assert(source.count == target.count, "cambium: arrays of a surface band have the same number of species");
    require_size(source.size(), size(), "the array of a surface band");
    require_size(target.size(), size(), "the result on a surface band");
    if (source.column(0).data() == target.column(0).data()) {
      throw ValueError("the array of a surface band is also the result: give two arrays");
    }
    work_.resize(std::max(work_.size(), static_cast<std::size_t>(execution.count())));
    for (Values& values : work_) values.fit(plan_, 1);
    for_each_piece_by_worker(execution, plan_.groups.size(), 1, [&](std::size_t w, std::size_t g, std::size_t) {
      for (int s = 0; s < source.count; ++s) {
        work_[w].read(plan_, plan_.groups[g], source.column(s).data());
        f(work_[w], plan_.groups[g], source.column(s).data(), target.column(s).data());
      }
    });
  }

  Params params_;
  std::optional<Lattice<D>> lattice_;
  detail::SheetPlan<T, D> plan_;
  ClosestPoints<K, T, D> points_;
  std::vector<Values> work_;
  std::optional<double> radius_;
};

}  // namespace cambium
