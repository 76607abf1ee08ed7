// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <type_traits>
#include <vector>

#include <cambium/interpolation/interpolator.hpp>
#include <cambium/kernels/m6.hpp>
#include <cambium/levelset/advection/mover.hpp>
#include <cambium/levelset/advection/velocity.hpp>
#include <cambium/levelset/field_patch.hpp>
#include <cambium/levelset/geometry/centred_differences.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/parallel/compensated_sum.hpp>
#include <cambium/surface/volume_ratio.hpp>
#include <cambium/time/rk4.hpp>

namespace cambium {

/// Species on particles around a moving interface (Bergdorf, Milde & Koumoutsakos, eq. 11.44): positions x_p, volumes
/// v_p, strengths C_p = v_p c_p and distances phi_p,
///   dx_p/dt = u,   dv_p/dt = v_p div u,   dphi_p/dt = 0,   dC_p/dt = v_p (F + D div((1 - n n) grad c)),
/// with u constant along normals. move() is the flow: strengths do not change, so their sum is conserved to the last
/// bit; remesh() gives strengths and volumes to the nodes of the interface that has moved by P2M, which conserves the
/// sums of both. FluxLaplacian is the exchange of strengths between nodes. Between steps an extension (ByClosestPoint,
/// or ByPde from time to time) makes c constant along normals again.
///
/// A particle sits at its foot on the interface plus phi_p times the normal there: feet move with u, normals are those
/// of the interface that has moved, so that the particles' velocity is constant along normals and phi_p is kept.
/// Volumes follow from the map of the particles, differenced on the lattice they started from: v_p / h^D = det dx_p/dX.
/// SurfaceTransport is the more accurate way for the same step.
/// \tparam C       number of species
/// \tparam Kernel  of the remeshing
/// \tparam S       stepper along the paths
template <int C = 1, int D = 3, class T = double, RemeshingKernel Kernel = M6, template <class, class> class S = RK4>
class SurfaceParticles {
 public:
  using Value = std::conditional_t<C == 1, T, Vec<C, T>>;
  using Values = Field<Value, D, Sparse>;

  struct Params {
    int substeps = 1;              ///< of the stepper in every move()
    double smallest_weight = 0.1;  ///< nodes that get less of the volume of a cell keep the value zero
  };

  /// \throws ValueError for options out of range
  explicit SurfaceParticles(const Params& params = {}) : params_(params) {
    if (params.substeps < 1 || !(params.smallest_weight > 0.0)) {
      throw ValueError(detail::message("surface particles with ", params.substeps, " substeps and smallest weight ",
                                       params.smallest_weight, ": at least 1 and above 0 are needed"));
    }
  }

  /// Puts a particle on every node of the band with a closest point; its concentration is that of the node.
  /// \throws SizeError unless c has the blocks of the band
  template <class Storage, Execution E = OpenMP>
  void take(const LevelSet<ClosestPoint, D, T, Storage>& level_set, const Values& c, const E& execution = {}) {
    const auto& band = level_set.band();
    require_same_blocks(c, band, "the concentrations that particles take");
    const auto& points = level_set.method().points();
    node_.clear();
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      for (std::size_t i = 0; i < band.volume; ++i) {
        if (band.in_band(band.values().block(b)[i]) && points.found(b, i)) node_.push_back({b, i});
      }
    }
    for (auto* arrays : {&x_, &foot_}) {
      for (auto& column : *arrays) column.resize(size());
    }
    phi_.resize(size());
    for (auto& column : sums_) column.resize(size());
    const T volume = static_cast<T>(std::pow(band.spacing(), D));
    for_each(execution, size(), [&](std::size_t p) {
      const auto [b, i] = node_[p];
      const Vec<D> x = band.lattice().position(band.values().node(b, i));
      for (int d = 0; d < D; ++d) {
        x_[d][p] = static_cast<T>(x[d]);
        foot_[d][p] = static_cast<T>(x[d] + static_cast<double>(points.offset(b, i)[d]) * band.spacing());
      }
      phi_[p] = band.values().block(b)[i];
      for (int s = 0; s < C; ++s) sums_[s][p] = volume * component(c.block(b)[i], s);
      sums_[C][p] = volume;
    });
  }

  /// Moves the particles from the interface they were taken from to where it is at t + dt.
  /// \param velocity  velocity(Vec<D, T> x, double time) -> Vec<D, T>, called by several threads
  /// \throws ValueError for a dt that is not positive and finite; what m2p throws
  template <class Storage, class V, Execution E = OpenMP>
  void move(const LevelSet<ClosestPoint, D, T, Storage>& before, V&& velocity, double t, double dt,
            const LevelSet<ClosestPoint, D, T, Storage>& after, const E& execution = {}) {
    detail::check_velocity<V, T, D>();
    detail::require_step(t, dt);
    move_(
        view(foot_), [](std::size_t) { return T(1); }, velocity, t, dt, params_.substeps, execution);
    if (!geometry_ || !(geometry_->normal.lattice() == after.lattice())) geometry_.emplace(after.lattice());
    find_geometry_(after.band(), *geometry_, execution);
    for (auto& column : normal_) column.resize(size());
    interpolator_.m2p(geometry_->normal, constant(foot_), view(normal_), execution);
    for_each(execution, size(), [&](std::size_t p) {
      Vec<D, T> n = view(normal_)[p];
      n /= norm(n);
      view(x_).set(p, view(foot_)[p] + phi_[p] * n);
    });
    ratio_.find(before.band(), node_, constant(x_), sums_[C], execution);
  }

  /// c := sum_p C_p W / sum_p v_p W on the nodes of an interface's band, zero where no particle is near: extend it.
  template <class Storage, Execution E = OpenMP>
  void remesh(const LevelSet<ClosestPoint, D, T, Storage>& level_set, Values& c, const E& execution = {}) {
    const auto& band = level_set.band();
    if (!on_nodes_ || !(on_nodes_->lattice() == band.lattice())) on_nodes_.emplace(band.lattice());
    std::array<const T*, C + 1> first;
    for (std::size_t s = 0; s <= C; ++s) first[s] = sums_[s].data();
    interpolator_.p2m(constant(x_), Columns<C + 1, const T>(first, size()), *on_nodes_, execution);
    take_blocks(c, band);
    const T least = static_cast<T>(params_.smallest_weight * std::pow(band.spacing(), D));
    for_each_piece(execution, band.blocks(), 1, [&](std::size_t b, std::size_t) {
      const auto to = c.block(b);
      const std::ptrdiff_t from = on_nodes_->find(band.values().block_index(b));
      for (std::size_t i = 0; i < to.size(); ++i) {
        const auto sums = from < 0 ? Vec<C + 1, T>{} : on_nodes_->block(static_cast<std::size_t>(from))[i];
        for (int s = 0; s < C; ++s) component(to[i], s) = sums[C] > least ? sums[s] / sums[C] : T(0);
      }
    });
  }

  std::size_t size() const { return node_.size(); }
  Columns<D, const T> positions() const { return constant(x_); }
  std::span<const T> strengths(int species) const { return sums_[static_cast<std::size_t>(species)]; }
  std::span<const T> volumes() const { return sums_[C]; }
  std::span<const T> distances() const { return phi_; }
  /// Sum of the strengths of a species, over particles, the same bits for any number of threads.
  double total(int species) const {
    CompensatedSum sum;
    for (const T strength : strengths(species)) sum += static_cast<double>(strength);
    return sum.value();
  }
  /// Sums of strengths and volumes that the last remesh() gave to nodes.
  const Field<Vec<C + 1, T>, D, Sparse>& on_nodes() const { return *on_nodes_; }

 private:
  using Arrays = std::array<AlignedVector<T>, D>;

  static Columns<D, T> view(Arrays& arrays) {
    std::array<T*, D> first;
    for (int d = 0; d < D; ++d) first[d] = arrays[d].data();
    return {first, arrays[0].size()};
  }
  static Columns<D, const T> constant(const Arrays& arrays) {
    std::array<const T*, D> first;
    for (int d = 0; d < D; ++d) first[d] = arrays[d].data();
    return {first, arrays[0].size()};
  }

  Params params_;
  std::vector<detail::BandNode> node_;  ///< where each particle started
  Arrays x_, foot_, normal_;
  AlignedVector<T> phi_;
  std::array<AlignedVector<T>, C + 1> sums_;  ///< strengths, then volumes
  detail::Mover<T, D, S> move_;
  typename CentredDifferences<4>::template Method<T, D> find_geometry_;
  std::optional<BandGeometry<T, D>> geometry_;  ///< of the interface that has moved
  detail::VolumeRatio<T, D> ratio_;
  Interpolator<Kernel> interpolator_;
  std::optional<Field<Vec<C + 1, T>, D, Sparse>> on_nodes_;
};

}  // namespace cambium
