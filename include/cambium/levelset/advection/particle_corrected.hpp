// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <cambium/interpolation/interpolator.hpp>
#include <cambium/levelset/advection/lagrangian.hpp>
#include <cambium/levelset/advection/markers.hpp>
#include <cambium/levelset/advection/mover.hpp>
#include <cambium/levelset/advection/velocity.hpp>

namespace cambium {

/// Options of ParticleCorrected; Base are those of the policy that advects phi.
template <class Base>
struct ParticleCorrectedParams {
  Base base = {};
  MarkerParams markers = {};
  /// Steps of the stepper for the markers in one step of the level set.
  int substeps = 1;
  /// phi is made a distance again after every so many steps, and corrected again; 0: left to the base.
  int reinitialise_every = 1;
  /// Markers are seeded anew after every so many steps; 0: never.
  int reseed_every = 20;
};

/// What a step did.
struct ParticleCorrectedReport {
  std::size_t markers = 0;  ///< at the end of the step
  std::size_t escaped = 0;  ///< corrections by escaped markers: after advection and after reinitialisation
  std::size_t dropped = 0;  ///< markers that left a bounded box
  bool reseeded = false;
};

/// The hybrid particle level set method (Enright, Fedkiw, Ferziger & Mitchell 2002): phi is advected by another policy,
/// and where markers of one side, which move with the flow, come to lie on the other side by more than their radius,
/// phi is corrected so that they touch it.
///
/// An object belongs to one level set: it keeps its markers from step to step.
/// \tparam Base  policy with Params and step(level_set, velocity, t, dt, execution); it should leave it to this one to
///               reinitialise, so that what that moves is corrected, too
/// \tparam S     stepper of the markers
template <class Base = Lagrangian<>, template <class, class> class S = RK4>
class ParticleCorrected {
 public:
  using Params = ParticleCorrectedParams<typename Base::Params>;

  /// \throws ValueError for options out of range
  explicit ParticleCorrected(const Params& params = {}) : params_(params), base_(params.base) {
    const MarkerParams& m = params.markers;
    if (params.substeps < 1 || params.reinitialise_every < 0 || params.reseed_every < 0 || m.per_cell < 0) {
      throw ValueError(detail::message("particle level set with ", params.substeps, " substeps, reinitialised every ",
                                       params.reinitialise_every, " and reseeded every ", params.reseed_every,
                                       " steps, ", m.per_cell,
                                       " markers a cell: substeps must be at least 1, the others not negative"));
    }
    if (!(m.smallest_radius > 0.0) || !(m.largest_radius >= m.smallest_radius) || !(m.width > m.smallest_radius) ||
        !(m.width <= 4.0)) {
      throw ValueError(detail::message("markers with radii from ", m.smallest_radius, " to ", m.largest_radius,
                                       " spacings up to ", m.width,
                                       " from the interface: radii must be positive and ascending, the width above "
                                       "the smallest radius and at most 4"));
    }
  }

  /// Advances the interface from t to t + dt with velocity(Vec<D, T> x, double time) -> Vec<D, T>, called by several
  /// threads. \throws what Base throws; the markers are then as before the step
  template <class Reinit, int D, class T, class Storage, class V, Execution E = OpenMP>
  ParticleCorrectedReport step(LevelSet<Reinit, D, T, Storage>& level_set, V&& velocity, double t, double dt,
                               const E& execution = {}) {
    detail::check_velocity<V, T, D>();
    detail::require_step(t, dt);
    auto& work = works_.template get<Work<T, D>>(level_set.lattice());
    if (!work.seeded) seed(level_set.band(), work, execution);
    work.moved = work.markers;
    work.move(
        work.moved.positions(), [](std::size_t) { return T(1); }, velocity, t, dt, params_.substeps, execution);
    base_.step(level_set, velocity, t, dt, execution);
    std::swap(work.markers, work.moved);
    ParticleCorrectedReport report;
    report.dropped = work.markers.stay_inside(level_set.lattice());
    report.escaped = correct(level_set, work, execution);
    ++work.steps;
    if (params_.reinitialise_every > 0 && work.steps % params_.reinitialise_every == 0) {
      level_set.reinitialise(execution);
      report.escaped += correct(level_set, work, execution);
    } else if (report.escaped > 0) {
      level_set.restore_band(execution);
    }
    work.markers.read(level_set.band(), execution);
    report.reseeded = params_.reseed_every > 0 && work.steps % params_.reseed_every == 0;
    if (report.reseeded) {
      work.markers.reseed(level_set.band(), params_.markers, static_cast<std::uint64_t>(work.steps), execution);
    }
    work.markers.touch(level_set.spacing(), params_.markers);
    report.markers = work.markers.size();
    return report;
  }

  /// The markers of a level set of scalars T on this lattice; none before the first step.
  template <class T = double, int D>
  const Markers<T, D>& markers(const Lattice<D>& lattice) {
    return works_.template get<Work<T, D>>(lattice).markers;
  }

 private:
  template <class T, int D>
  struct Work {
    explicit Work(const Lattice<D>& lattice)
        : engine{lattice},
          outside(lattice, -std::numeric_limits<T>::infinity()),
          inside(lattice, std::numeric_limits<T>::infinity()) {}
    detail::OnLattice<D> engine;
    Markers<T, D> markers;
    Markers<T, D> moved;
    detail::Mover<T, D, S> move;
    /// What escaped markers say of phi at the nodes around them: the largest of those of the outside, the smallest of
    /// those of the inside.
    Field<T, D, Sparse> outside;
    Field<T, D, Sparse> inside;
    bool seeded = false;
    int steps = 0;
  };

  template <class T, int D, class E>
  void seed(const NarrowBand<T, D>& band, Work<T, D>& work, const E& execution) {
    work.markers.read(band, execution);
    work.markers.reseed(band, params_.markers, 0, execution);
    work.seeded = true;
  }

  /// phi := what escaped markers say where it is nearer to the interface: of the larger of phi and the outside's and
  /// the smaller of phi and the inside's the one of smaller modulus. \return number of escaped markers
  template <class L, class T, int D, class E>
  static std::size_t correct(L& level_set, Work<T, D>& work, const E& execution) {
    const NarrowBand<T, D>& old = level_set.band();
    work.markers.read(old, execution);
    work.outside.clear();
    work.inside.clear();
    std::size_t escaped = 0;
    for (std::size_t p = 0; p < work.markers.size(); ++p) {
      if (!work.markers.escaped(p)) continue;
      ++escaped;
      ask(old, work, p);
    }
    if (escaped == 0) return 0;
    level_set.replace(
        [&](detail::BlockMarks<D>& marks) {
          for (const Field<T, D, Sparse>* field :
               {&old.values(), &std::as_const(work.outside), &std::as_const(work.inside)}) {
            for (std::size_t b = 0; b < field->blocks(); ++b) {
              marks.mark(field->block_origin(b), field->block_origin(b));
            }
          }
        },
        [&](NarrowBand<T, D>& band, std::size_t b, std::size_t) {
          write_block(old, work, band, b);
          return true;
        },
        execution);
    return escaped;
  }
  /// Enters the value of the ball of marker p at the corners of its cell.
  template <class T, int D>
  static void ask(const NarrowBand<T, D>& band, Work<T, D>& work, std::size_t p) {
    const Lattice<D>& lattice = band.lattice();
    const Vec<D, T> x = std::as_const(work.markers).positions()[p];
    const T radius = work.markers.radius()[p];
    for (std::size_t corner = 0; corner < (std::size_t{1} << D); ++corner) {
      Index<D> node = detail::BandReader<T, D>::cell(lattice, x);
      for (int d = 0; d < D; ++d) node[d] += static_cast<std::ptrdiff_t>(corner >> d & 1u);
      const Vec<D> at = lattice.position(node);  // of a node beyond a periodic face the place next to the marker
      node = band.inside(node);
      T distance{};
      for (int d = 0; d < D; ++d) distance += (static_cast<T>(at[d]) - x[d]) * (static_cast<T>(at[d]) - x[d]);
      distance = std::sqrt(distance);
      if (radius > T(0)) {
        work.outside.set(node, std::max(std::as_const(work.outside)(node), radius - distance));
      } else {
        work.inside.set(node, std::min(std::as_const(work.inside)(node), radius + distance));
      }
    }
  }
  template <class T, int D>
  static void write_block(const NarrowBand<T, D>& old, const Work<T, D>& work, NarrowBand<T, D>& band, std::size_t b) {
    const Index<D> block = band.values().block_index(b);
    const auto to = band.values().block(b);
    const std::ptrdiff_t from = old.values().find(block);
    if (from < 0) {
      std::fill(to.begin(), to.end(), old.far_value(block));
    } else {
      std::ranges::copy(old.values().block(static_cast<std::size_t>(from)), to.begin());
    }
    for (std::size_t i = 0; i < to.size(); ++i) {
      const Index<D> node = band.values().node(b, i);
      if (!band.lattice().contains(node)) continue;
      const T upper = std::max(to[i], work.outside(node));
      const T lower = std::min(to[i], work.inside(node));
      to[i] = std::abs(upper) <= std::abs(lower) ? upper : lower;
    }
  }

  Params params_;
  Base base_;
  detail::PlanStore works_;
};

}  // namespace cambium
