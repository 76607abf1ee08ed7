// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <cambium/levelset/advection/velocity.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/reinit/band_work.hpp>
#include <cambium/levelset/weno.hpp>
#include <cambium/time/tvd_rk3.hpp>

namespace cambium {

/// Options of Eulerian.
struct EulerianParams {
  /// Largest |u_x| dt / h + |u_y| dt / h + ... of a sub-step.
  double cfl = 0.5;
  /// Sub-steps after which the band is rebuilt around the interface.
  int rebuild_every = 1;
  /// Every so many rebuilds phi is made a distance; in between it is only cut off, so that nodes that the interface
  /// leaves behind stay in the band as long. 0 for never.
  int reinitialise_every = 1;
};

/// What a step did.
struct EulerianReport {
  std::size_t substeps = 0;
  std::size_t reinitialisations = 0;
};

/// Eulerian advection, d phi / dt + u . grad phi = 0 on the band: upwind derivatives by Scheme (Jiang & Peng 2000) and
/// sub-steps of stepper S as short as the CFL number asks.
template <class Scheme = WENO5, template <class, class> class S = TVDRK3>
class Eulerian {
 public:
  using Params = EulerianParams;

  /// \throws ValueError for options out of range
  explicit Eulerian(const Params& params = {}) : params_(params) {
    if (!(params.cfl > 0.0) || !(params.cfl <= 1.0) || params.rebuild_every < 1 || params.reinitialise_every < 0) {
      throw ValueError(detail::message("Eulerian advection at CFL ", params.cfl, ", rebuilding every ",
                                       params.rebuild_every, " sub-steps and reinitialising every ",
                                       params.reinitialise_every,
                                       ": they must be in (0, 1], above 0 and not negative"));
    }
  }

  /// Advances the interface from t to t + dt with velocity(Vec<D, T> x, double time) -> Vec<D, T>, called by several
  /// threads. \throws ValueError if the velocity is not finite or the band too thin for the options, InterfaceError if
  /// the interface vanishes or leaves the band; the level set is then as it was
  template <class Reinit, int D, class T, class V, Execution E = OpenMP>
  EulerianReport step(LevelSet<Reinit, D, T>& level_set, V&& velocity, double t, double dt, const E& execution = {}) {
    detail::check_velocity<V, T, D>();
    detail::require_step(t, dt);
    require_width(level_set.band());
    const NarrowBand<T, D> start = level_set.band();
    const int rebuilds = rebuilds_;
    try {
      return advance(level_set, velocity, t, dt, execution);
    } catch (...) {
      store(start, level_set, execution);
      rebuilds_ = rebuilds;
      throw;
    }
  }

 private:
  static constexpr std::size_t lanes = detail::row_lanes;

  template <class T, int D, class E>
  struct Work {
    Work(const NarrowBand<T, D>& from, const E& execution)
        : band(from), stage(from), stepper(execution), patches(static_cast<std::size_t>(execution.count())) {}
    NarrowBand<T, D> band;
    NarrowBand<T, D> stage;  ///< what the stepper asks the rate of
    S<std::span<T>, E> stepper;
    std::vector<Patch<T, D>> patches;
    std::vector<double> fastest;
  };

  /// The interface moves so far, and the stencils reach so far, before the band is rebuilt.
  template <class T, int D>
  void require_width(const NarrowBand<T, D>& band) const {
    const double needed = params_.cfl * params_.rebuild_every + static_cast<double>(Scheme::reach);
    const double width = static_cast<double>(band.half_width()) / band.spacing();
    if (width >= needed) return;
    throw ValueError(detail::message("the band is ", width, " spacings wide to either side and ", needed,
                                     " are needed: widen it or rebuild it more often"));
  }

  template <class L, class V, class E>
  EulerianReport advance(L& level_set, V&& velocity, double t, double dt, const E& execution) {
    using T = typename L::Scalar;
    Work<T, L::dimension, E> work(level_set.band(), execution);
    EulerianReport report;
    int since = 0;
    for (double done = 0.0; done < dt;) {
      const double speed = fastest(work, velocity, t + done, execution);
      const double parts = std::max(1.0, std::ceil((dt - done) * speed / (params_.cfl * work.band.spacing())));
      const double part = (dt - done) / parts;
      const std::span<T> phi = all_of(work.band);
      work.stepper.step(phi, t + done, part, [&](std::span<const T> at, double time, std::span<T> rate) {
        find_rate(work, at, velocity, time, rate, execution);
      });
      done = parts > 1.0 ? done + part : dt;
      ++report.substeps;
      if (++since < params_.rebuild_every && done < dt) continue;
      since = 0;
      store(work.band, level_set, execution);
      ++rebuilds_;
      if (params_.reinitialise_every > 0 && rebuilds_ % params_.reinitialise_every == 0) {
        level_set.reinitialise(execution);
        ++report.reinitialisations;
      } else {
        level_set.trim();
      }
      if (done < dt) work.stage = work.band = level_set.band();
    }
    return report;
  }

  /// Largest sum of the components' sizes over the nodes in the band.
  template <class W, class V, class E>
  static double fastest(W& work, V&& velocity, double time, const E& execution) {
    const auto& band = work.band;
    work.fastest.assign(band.blocks(), 0.0);
    for_each_piece(execution, band.blocks(), 1, [&](std::size_t b, std::size_t) {
      for (std::size_t i = 0; i < band.volume; ++i) {
        if (!band.in_band(band.values().block(b)[i])) continue;
        const auto node = band.values().node(b, i);
        if (!band.lattice().contains(node)) continue;
        const auto u = velocity_at(band, node, velocity, time);
        double sum = 0.0;
        for (int d = 0; d < band.dimension; ++d) sum += std::abs(static_cast<double>(u[d]));
        work.fastest[b] = std::max(work.fastest[b], sum);
      }
    });
    return std::ranges::max(work.fastest);
  }
  template <class T, int D, class V>
  static Vec<D, T> velocity_at(const NarrowBand<T, D>& band, const Index<D>& node, V&& velocity, double time) {
    const Vec<D> position = band.lattice().position(node);
    Vec<D, T> x;
    for (int d = 0; d < D; ++d) x[d] = static_cast<T>(position[d]);
    const Vec<D, T> u = velocity(x, time);
    if (!std::isfinite(dot(u, u))) {
      throw ValueError(detail::message("the velocity at ", position, " at time ", time, " is ", u,
                                       ": it must be finite and not overflow when squared"));
    }
    return u;
  }

  /// The values of all blocks of a band as one array.
  template <class T, int D>
  static std::span<T> all_of(NarrowBand<T, D>& band) {
    return {band.values().block(0).data(), band.blocks() * band.volume};
  }

  /// rate := -u . grad phi
  template <class T, int D, class E, class V>
  static void find_rate(Work<T, D, E>& work, std::span<const T> at, V&& velocity, double time, std::span<T> rate,
                        const E& execution) {
    const std::span<T> stage = all_of(work.stage);
    for_each_piece(execution, at.size(), 4096, [&](std::size_t begin, std::size_t end) {
      std::copy(at.begin() + static_cast<std::ptrdiff_t>(begin), at.begin() + static_cast<std::ptrdiff_t>(end),
                stage.begin() + static_cast<std::ptrdiff_t>(begin));
    });
    for_each_piece_by_worker(execution, work.stage.blocks(), 1, [&](std::size_t w, std::size_t b, std::size_t) {
      Patch<T, D>& patch = work.patches[w];
      patch.read_block(work.stage, b, Scheme::reach);
      for (std::size_t i = 0; i < work.stage.volume; i += lanes) {
        rate_of_row(work.stage, b, i, patch, velocity, time, rate.data() + b * work.stage.volume + i);
      }
    });
  }
  template <class T, int D, class V>
  static void rate_of_row(const NarrowBand<T, D>& band, std::size_t b, std::size_t i, const Patch<T, D>& patch,
                          V&& velocity, double time, T* rate) {
    using Lanes = simd::Pack<T, lanes>;
    const T* at = patch.data() + patch.entry(i);
    std::fill_n(rate, lanes, T(0));
    if (!(detail::smallest_around<lanes>(at, patch.stride()) < band.half_width())) return;
    alignas(64) T component[D][lanes] = {};
    alignas(64) T from_left[D][lanes] = {};
    for (std::size_t l = 0; l < lanes; ++l) {
      const Index<D> node = band.values().node(b, i + l);
      if (!band.lattice().contains(node)) continue;
      const Vec<D, T> u = velocity_at(band, node, velocity, time);
      for (int d = 0; d < D; ++d) {
        component[d][l] = u[d];
        from_left[d][l] = u[d] > T(0) ? T(1) : T(0);
      }
    }
    Lanes sum(T(0));
    for (int d = 0; d < D; ++d) {
      const auto differences = detail::row_differences<Scheme, lanes>(at, patch.stride()[d]);
      const Lanes slope = differences.upwind(Lanes::load_aligned(from_left[d]));
      sum = fma(Lanes::load_aligned(component[d]), slope, sum);
    }
    (sum * Lanes(static_cast<T>(-1.0 / band.spacing()))).store(rate);
  }

  /// Gives the level set the blocks and values of a band.
  template <class T, int D, class L, class E>
  static void store(const NarrowBand<T, D>& band, L& level_set, const E& execution) {
    level_set.replace(
        [&](detail::BlockMarks<D>& marks) {
          for (std::size_t b = 0; b < band.blocks(); ++b) {
            const Index<D> low = band.values().block_origin(b);
            Index<D> high;
            for (int d = 0; d < D; ++d) high[d] = std::min(low[d] + band.extent, band.lattice().nodes()[d]) - 1;
            marks.mark(low, high);
          }
        },
        [&](NarrowBand<T, D>& to, std::size_t b, std::size_t) {
          const std::ptrdiff_t from = band.values().find(to.values().block_index(b));
          std::ranges::copy(band.values().block(static_cast<std::size_t>(from)), to.values().block(b).begin());
          return true;
        },
        execution);
  }

  Params params_;
  int rebuilds_ = 0;
};

}  // namespace cambium
