// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <cambium/interpolation/plan_store.hpp>
#include <cambium/kernels/remeshing_kernel.hpp>
#include <cambium/levelset/advection/paths.hpp>
#include <cambium/levelset/advection/velocity.hpp>
#include <cambium/levelset/front.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/nearest_points.hpp>
#include <cambium/levelset/point_bins.hpp>
#include <cambium/time/rk4.hpp>

namespace cambium {

/// Options of Backward.
struct BackwardParams {
  /// Steps of the stepper in one step of the level set, or 0 for as many as path_error asks.
  int substeps = 0;
  /// What the stepper may put a point of the interface off by in a step, in spacings.
  double path_error = 1e-3;
  /// phi is made a distance again when |grad phi| next to the interface is off by so many octaves, in the mean.
  double octaves = 1.0;
  /// A step that pulls neighbouring points of the interface further apart than so many spacings is cut in two.
  double longest_stretch = 4.0;
};

/// What a step did.
struct AdvectionReport {
  std::size_t steps = 0;              ///< interpolations of phi: more than one if the step was cut
  int substeps = 0;                   ///< steps of the stepper in the last of them
  std::size_t cuts = 0;               ///< parts that were cut because the interface left the band
  std::size_t reinitialisations = 0;  ///< of these, how many were followed by a reinitialisation
  Slopes slopes;                      ///< |grad phi| next to the interface at the end, before a reinitialisation
};

/// Lagrangian advection by long steps. Particles that will be at the nodes of the new band are followed back to where
/// they come from and bring phi from there, interpolated by kernel K.
///
/// The step is bound neither by a CFL number nor by the strain: particles arrive on the lattice, so that there is
/// nothing to remesh, and the fewer steps, the fewer interpolations. phi is made a distance again only when the
/// diagnostic asks.
template <class K = Lambda<4, 4>, template <class, class> class S = RK4>
class Backward {
 public:
  using Params = BackwardParams;

  /// \throws ValueError for options out of range
  explicit Backward(const Params& params = {}) : params_(params) {
    check_remeshing_kernel<K>();
    static_assert(is_interpolating<K>,
                  "cambium: backward advection interpolates phi: take a kernel with W(0) = 1 and W(k) = 0 at the other "
                  "integers, such as Lambda or M4Prime");
    if (params.substeps < 0 || !(params.path_error > 0.0) || !(params.octaves > 0.0) ||
        !(params.longest_stretch > 1.0)) {
      throw ValueError(detail::message("backward advection with ", params.substeps, " substeps, paths off by ",
                                       params.path_error, " spacings, slopes by ", params.octaves,
                                       " octaves and longest stretch ", params.longest_stretch,
                                       ": they must be 0 or more, above 0, above 0 and above 1"));
    }
  }

  /// Advances the interface from t to t + dt with velocity(Vec<D, T> x, double time) -> Vec<D, T>, called by several
  /// threads. \throws PositionError if the interface's surroundings come from outside a bounded box, InterfaceError if
  /// it reaches its wall or vanishes, ValueError if paths cannot be followed to within Params::path_error; the level
  /// set is then as after the last part of the step that succeeded
  template <class Reinit, int D, class T, class Storage, class V, Execution E = OpenMP>
  AdvectionReport step(LevelSet<Reinit, D, T, Storage>& level_set, V&& velocity, double t, double dt,
                       const E& execution = {}) {
    detail::check_velocity<V, T, D>();
    detail::require_step(t, dt);
    AdvectionReport report;
    auto& work = works_.template get<Work<T, D>>(level_set.lattice());
    const auto workers = static_cast<std::size_t>(execution.count());
    if (work.worker.size() < workers) work.worker.resize(workers);
    work.paths.fit(workers);
    advance(level_set, velocity, t, dt, execution, work, report);
    return report;
  }

 private:
  /// Distance from the interface, in spacings, up to which phi must be right for the stencils of the next step.
  static constexpr double clean = 5.0;
  static constexpr std::size_t most_cuts = 20;

  template <class T, int D>
  struct Worker {
    detail::NearestPoints<T, D, char> nearest;
    Patch<T, D> patch;
    std::vector<std::size_t> node;
    std::vector<Vec<D, T>> from;
  };
  template <class T, int D>
  struct Work {
    explicit Work(const Lattice<D>& lattice) : engine{lattice} {}
    detail::OnLattice<D> engine;
    Front<T, D> front;
    detail::PointBins<T, D> bins;
    detail::Paths<S, T, D> paths;
    std::vector<Worker<T, D>> worker;
  };

  template <class L, class V, class E, class T, int D>
  void advance(L& level_set, V&& velocity, double t, double dt, const E& execution, Work<T, D>& work,
               AdvectionReport& report) const {
    const Lattice<D>& lattice = level_set.lattice();
    work.front.take(level_set.band(), execution);
    const Columns<D, T> front = work.front.positions();
    const int substeps = params_.substeps > 0 ? params_.substeps
                                              : work.paths.substeps(front, lattice.spacing(), params_.path_error,
                                                                    velocity, t, dt, execution);
    report.substeps = substeps;
    work.paths.push(front, velocity, t, dt, substeps, execution);
    work.bins.fill(lattice, front);
    const double stretch = work.front.stretch(lattice.spacing());
    if (stretch > params_.longest_stretch) {
      return advance_by_halves(level_set, velocity, t, dt, execution, work, report);
    }
    // A point of the interface is at most half of a stretched diagonal away from a point of the front.
    const double radius = clean + 0.5 * std::sqrt(static_cast<double>(D)) * std::max(stretch, 1.0);
    try {
      arrive(level_set, velocity, t, dt, substeps, radius, execution, work);
    } catch (const BandError&) {
      // A part of the interface that no node saw has come apart from the front; shorter steps do not lose it.
      if (++report.cuts > most_cuts) throw;
      return advance_by_halves(level_set, velocity, t, dt, execution, work, report);
    }
    ++report.steps;
    work.front.take(level_set.band(), execution);
    report.slopes = work.front.slopes();
    if (report.slopes.mean_octaves > params_.octaves) {
      level_set.reinitialise(execution);
      ++report.reinitialisations;
    } else {
      level_set.restore_band(execution);
    }
  }

  template <class L, class V, class E, class T, int D>
  void advance_by_halves(L& level_set, V&& velocity, double t, double dt, const E& execution, Work<T, D>& work,
                         AdvectionReport& report) const {
    advance(level_set, velocity, t, 0.5 * dt, execution, work, report);
    advance(level_set, velocity, t + 0.5 * dt, 0.5 * dt, execution, work, report);
  }

  /// phi of the nodes within `radius` of the front that was moved.
  template <class L, class V, class E, class T, int D>
  void arrive(L& level_set, V&& velocity, double t, double dt, int substeps, double radius, const E& execution,
              Work<T, D>& work) const {
    const NarrowBand<T, D>& old = level_set.band();
    const auto reach = static_cast<std::ptrdiff_t>(std::ceil(radius));
    level_set.replace(
        [&](detail::BlockMarks<D>& marks) {
          const Columns<D, T> x = work.front.positions();
          for (std::size_t p = 0; p < x.size(); ++p) {
            const Vec<D, T> u = work.bins.spacings(old.lattice(), x[p]);
            Index<D> low, high;
            for (int d = 0; d < D; ++d) {
              low[d] = static_cast<std::ptrdiff_t>(std::ceil(u[d] - static_cast<T>(radius)));
              high[d] = static_cast<std::ptrdiff_t>(std::floor(u[d] + static_cast<T>(radius)));
            }
            marks.mark(low, high);
          }
        },
        [&](NarrowBand<T, D>& band, std::size_t b, std::size_t w) {
          Worker<T, D>& worker = work.worker[w];
          if (!find_near(band, b, work.bins, radius, reach, worker)) return false;
          come_from(band, b, velocity, t + dt, dt, substeps, work.paths.group(w), worker);
          bring(old, band, b, worker);
          return true;
        },
        execution);
  }
  /// Nodes of block b that are near the front. \return false if there are none
  template <class T, int D>
  static bool find_near(const NarrowBand<T, D>& band, std::size_t b, const detail::PointBins<T, D>& bins, double radius,
                        std::ptrdiff_t reach, Worker<T, D>& worker) {
    worker.nearest.reset(static_cast<T>(radius));
    const Index<D> block = band.values().block_index(b);
    detail::for_each_block_within(band.lattice(), block, reach, [&](const Index<D>& other, const Index<D>& shift) {
      for (const Vec<D, T>& point : bins[other]) {
        Vec<D, T> local;
        for (int d = 0; d < D; ++d) {
          local[d] = point[d] - static_cast<T>(other[d] * BlockShape<D>::extent - shift[d]);
        }
        worker.nearest.offer(local, '\0');
      }
    });
    worker.node.clear();
    if (worker.nearest.empty()) return false;
    worker.nearest.settle();
    for (std::size_t i = 0; i < band.volume; ++i) {
      if (worker.nearest.found(i) && band.lattice().contains(band.values().node(b, i))) worker.node.push_back(i);
    }
    return !worker.node.empty();
  }
  /// Where the particles that arrive at those nodes at `time` were dt ago, in spacings from the first node.
  template <class T, int D, class V>
  static void come_from(const NarrowBand<T, D>& band, std::size_t b, V&& velocity, double time, double dt, int substeps,
                        detail::PathGroup<S, T, D>& particles, Worker<T, D>& worker) {
    const Lattice<D>& lattice = band.lattice();
    constexpr std::size_t group = detail::PathGroup<S, T, D>::size;
    const Columns<D, T> at = particles.positions();
    worker.from.resize(worker.node.size());
    for (std::size_t begin = 0; begin < worker.node.size(); begin += group) {
      const std::size_t end = std::min(worker.node.size(), begin + group);
      for (std::size_t k = 0; k < group; ++k) {
        const Vec<D> x = lattice.position(band.values().node(b, worker.node[std::min(begin + k, end - 1)]));
        for (int d = 0; d < D; ++d) at.column(d)[k] = static_cast<T>(x[d]);
      }
      particles.follow(velocity, time, dt, substeps, -1.0);
      for (std::size_t p = begin; p < end; ++p) {
        const Vec<D, T> x = at[p - begin];
        require_inside(lattice, x);
        for (int d = 0; d < D; ++d) {
          worker.from[p][d] = static_cast<T>((static_cast<double>(x[d]) - lattice.box().lo[d]) / lattice.spacing());
        }
      }
    }
  }
  template <class T, int D>
  static void require_inside(const Lattice<D>& lattice, const Vec<D, T>& x) {
    for (int d = 0; d < D; ++d) {
      const double slack = 1e-6 * lattice.spacing();
      const bool inside = x[d] >= lattice.box().lo[d] - slack && x[d] <= lattice.box().hi[d] + slack;
      if (std::isfinite(x[d]) && (inside || lattice.periodic(d))) continue;
      throw PositionError(detail::message("a particle next to the interface comes from ", x,
                                          ", outside the box along axis ", d,
                                          ": enlarge the box, or check the velocity"));
    }
  }
  /// phi at the worker's nodes of block b := phi of the old band where they come from.
  template <class T, int D>
  static void bring(const NarrowBand<T, D>& old, NarrowBand<T, D>& band, std::size_t b, Worker<T, D>& worker) {
    Index<D> low = Index<D>::constant(std::numeric_limits<std::ptrdiff_t>::max());
    Index<D> high = Index<D>::constant(std::numeric_limits<std::ptrdiff_t>::min());
    for (const Vec<D, T>& from : worker.from) {
      for (int d = 0; d < D; ++d) {
        const auto cell = static_cast<std::ptrdiff_t>(std::floor(from[d]));
        low[d] = std::min(low[d], cell - K::support / 2);
        high[d] = std::max(high[d], cell + 1 + K::support / 2);
      }
    }
    worker.patch.read(old, low, high - low + Index<D>::constant(1));
    const auto phi = band.values().block(b);
    std::fill(phi.begin(), phi.end(), std::numeric_limits<T>::quiet_NaN());
    for (std::size_t p = 0; p < worker.node.size(); ++p) {
      Vec<D, T> u;
      for (int d = 0; d < D; ++d) u[d] = worker.from[p][d] - static_cast<T>(low[d]);
      phi[worker.node[p]] = Interpolant<K, T, D>::value(worker.patch.data(), worker.patch.stride(), u);
    }
  }

  Params params_;
  /// Buffers serve again as long as the lattice is the same.
  detail::PlanStore works_;
};

}  // namespace cambium
