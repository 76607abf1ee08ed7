// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <cambium/interpolation/interpolator.hpp>
#include <cambium/kernels/m6.hpp>
#include <cambium/levelset/advection/band_particles.hpp>
#include <cambium/levelset/advection/cutoff.hpp>
#include <cambium/levelset/advection/mover.hpp>
#include <cambium/levelset/advection/steepest_slope.hpp>
#include <cambium/levelset/advection/velocity.hpp>
#include <cambium/levelset/front.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/time/rk4.hpp>

namespace cambium {

/// Options of Lagrangian.
struct LagrangianParams {
  /// Steps of the stepper between two remeshings.
  int substeps = 1;
  /// The velocity is cut off between these distances from the interface, in spacings: chi of eq. 11.69. Infinite ones
  /// move the whole band as it is.
  double inner = std::numeric_limits<double>::infinity();
  double outer = std::numeric_limits<double>::infinity();
  /// A step that moves neighbouring particles apart by more than so many spacings is cut into parts.
  double largest_distortion = 0.5;
  /// phi is made a distance again after every so many remeshings; 0: only when the slopes ask for it, that is, when
  /// |grad phi| next to the interface is off by so many octaves in the mean or, where the velocity is cut off, above
  /// `steepest` anywhere in the band.
  int reinitialise_every = 0;
  double octaves = 1.0;
  double steepest = 2.0;
  /// Nodes with a smaller sum of weights are no longer in the band.
  double smallest_weight = 0.1;
};

/// What a step did.
struct LagrangianReport {
  std::size_t remeshings = 0;         ///< more than one if the step was cut into parts
  std::size_t reinitialisations = 0;  ///< of these, how many were followed by a reinitialisation
  std::size_t particles = 0;          ///< of the last part
  double distortion = 0.0;            ///< largest of a part, in spacings
};

/// Lagrangian advection with remeshing: particles on the nodes of the band carry phi, move with the flow, and give phi
/// back to the nodes as phi_i = sum_p phi_p W / sum_p W (eq. 11.30-11.31) with kernel W.
///
/// Particles may travel any number of spacings between two remeshings; what limits a step is the distortion of their
/// lattice, on which the error of the renormalised sum depends (to the power of the kernel's order), and, with a
/// velocity that is cut off, the distance within which it falls to zero.
template <RemeshingKernel Kernel = M6, template <class, class> class S = RK4>
class Lagrangian {
 public:
  using Params = LagrangianParams;

  /// \throws ValueError for options out of range
  explicit Lagrangian(const Params& params = {}) : params_(params) {
    check_remeshing_kernel<Kernel>();
    const bool cut_off = params.inner >= 0.0 && (params.outer > params.inner || std::isinf(params.inner));
    if (params.substeps < 1 || !cut_off || !(params.largest_distortion > 0.0 && params.largest_distortion < 1.0) ||
        params.reinitialise_every < 0 || !(params.octaves > 0.0) || !(params.steepest > 1.0) ||
        !(params.smallest_weight > 0.0)) {
      throw ValueError(detail::message(
          "Lagrangian advection with ", params.substeps, " substeps, cut-off from ", params.inner, " to ", params.outer,
          " spacings, distortion ", params.largest_distortion, ", reinitialisation every ", params.reinitialise_every,
          " remeshings, at ", params.octaves, " octaves or slope ", params.steepest, ", smallest weight ",
          params.smallest_weight,
          ": substeps must be at least 1, the cut-off from 0 or more upwards, the distortion between 0 and 1, "
          "reinitialisations not negative, octaves and weight above 0, the slope above 1"));
    }
  }

  const Params& params() const { return params_; }

  /// Advances the interface from t to t + dt with velocity(Vec<D, T> x, double time) -> Vec<D, T>, called by several
  /// threads.
  /// \throws PositionError if a particle leaves a bounded box or its position is not finite, InterfaceError if the
  ///         interface vanishes; the level set is then as after the last part of the step that succeeded
  template <class Reinit, int D, class T, class Storage, class V, Execution E = OpenMP>
  LagrangianReport step(LevelSet<Reinit, D, T, Storage>& level_set, V&& velocity, double t, double dt,
                        const E& execution = {}) {
    detail::check_velocity<V, T, D>();
    detail::require_step(t, dt);
    auto& work = works_.template get<Work<T, D>>(level_set.lattice());
    LagrangianReport report;
    advance(level_set, velocity, t, dt, execution, work, report);
    return report;
  }

 private:
  /// Nodes around the band whose particles have a part in the sums of its nodes, with one more for the distortion.
  static constexpr std::ptrdiff_t reach = Kernel::support / 2 + 1;
  /// Where phi becomes constant, kernels overshoot by less than this, in spacings: such values are taken for constant,
  /// or the band would grow with every remeshing.
  static constexpr double ripple = 0.1;
  /// A step is not cut into more parts than this at once.
  static constexpr double most_parts = 1e4;

  template <class T, int D>
  struct Work {
    explicit Work(const Lattice<D>& lattice) : engine{lattice}, phi(lattice, std::numeric_limits<T>::quiet_NaN()) {}
    detail::OnLattice<D> engine;
    detail::BandParticles<T, D> particles;
    detail::Mover<T, D, S> move;
    Field<T, D, Sparse> phi;
    Front<T, D> front;
    std::vector<Patch<T, D>> patches;
  };

  template <class L, class V, class E, class T, int D>
  void advance(L& level_set, V&& velocity, double t, double dt, const E& execution, Work<T, D>& work,
               LagrangianReport& report) {
    const NarrowBand<T, D>& band = level_set.band();
    work.particles.take(band, reach, execution);
    const Cutoff<T> cutoff{static_cast<T>(params_.inner * band.spacing()),
                           static_cast<T>(params_.outer * band.spacing())};
    const Columns<1, const T> phi = work.particles.phi();
    work.move(
        work.particles.positions(), [&](std::size_t p) { return cutoff(phi.column(0)[p]); }, velocity, t, dt,
        params_.substeps, execution);
    const double distortion = work.particles.distortion(band, execution);
    if (distortion > params_.largest_distortion) {
      const double parts = std::ceil(distortion / params_.largest_distortion);
      if (!(parts < most_parts)) {
        throw PositionError(detail::message("particles of the band that were neighbours move apart by ", distortion,
                                            " spacings from time ", t, " to ", t + dt, ": check the velocity"));
      }
      for (double part = 0.0; part < parts; part += 1.0) {
        advance(level_set, velocity, t + part * dt / parts, dt / parts, execution, work, report);
      }
      return;
    }
    work.particles.drop_far_outside(band);
    remesh(level_set, execution, work);
    ++report.remeshings;
    report.particles = work.particles.size();
    report.distortion = std::max(report.distortion, distortion);
    if (is_time_to_reinitialise(band, work, execution)) {
      ++report.reinitialisations;
      level_set.reinitialise(execution);
    } else {
      level_set.restore_band(execution);
    }
  }

  template <class L, class E, class T, int D>
  void remesh(L& level_set, const E& execution, Work<T, D>& work) {
    const Columns<D, T> x = work.particles.positions();
    interpolator_.p2m_renormalised(
        Columns<D, const T>(x), work.particles.phi(), work.phi,
        {.smallest_weight = params_.smallest_weight, .fallback = std::numeric_limits<T>::quiet_NaN()}, execution);
    level_set.replace(
        [&](detail::BlockMarks<D>& marks) {
          for (std::size_t b = 0; b < work.phi.blocks(); ++b) {
            marks.mark(work.phi.block_origin(b), work.phi.block_origin(b));
          }
        },
        [&](NarrowBand<T, D>& band, std::size_t b, std::size_t) { return write_block(work.phi, band, b); }, execution);
  }
  /// \return false if no node of the block has a value
  template <class T, int D>
  static bool write_block(const Field<T, D, Sparse>& phi, NarrowBand<T, D>& band, std::size_t b) {
    const auto from = phi.block(static_cast<std::size_t>(phi.find(band.values().block_index(b))));
    const auto to = band.values().block(b);
    const T edge = band.half_width() - static_cast<T>(ripple * band.spacing());
    bool any = false;
    for (std::size_t i = 0; i < to.size(); ++i) {
      const bool known = !std::isnan(from[i]) && band.lattice().contains(band.values().node(b, i));
      any |= known;
      to[i] = known ? from[i] : std::numeric_limits<T>::quiet_NaN();
      if (std::abs(to[i]) > edge) to[i] = std::copysign(band.half_width(), to[i]);
    }
    return any;
  }

  template <class T, int D, class E>
  bool is_time_to_reinitialise(const NarrowBand<T, D>& band, Work<T, D>& work, const E& execution) {
    ++remeshings_;
    if (params_.reinitialise_every > 0) return remeshings_ % params_.reinitialise_every == 0;
    work.front.take(band, execution);
    if (work.front.slopes().mean_octaves > params_.octaves) return true;
    return std::isfinite(params_.inner) && detail::steepest_slope(band, work.patches, execution) > params_.steepest;
  }

  Params params_;
  int remeshings_ = 0;
  Interpolator<Kernel> interpolator_;
  detail::PlanStore works_;
};

}  // namespace cambium
