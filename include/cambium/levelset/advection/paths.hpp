// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <cambium/core/aligned.hpp>
#include <cambium/core/columns.hpp>
#include <cambium/core/error.hpp>
#include <cambium/parallel/execution.hpp>

namespace cambium::detail {

/// Points that one thread follows along a velocity at a time, so many that its stepper S keeps its buffers.
template <template <class, class> class S, class T, int D>
class PathGroup {
 public:
  static constexpr std::size_t size = 64;

  PathGroup() : stepper_(positions(), Serial{}) {}

  Columns<D, T> positions() {
    std::array<T*, D> first;
    for (int d = 0; d < D; ++d) first[d] = x_[d].data();
    return {first, size};
  }
  /// Moves the points by dt along `way` times the velocity, from time t on: way = -1 goes back in time.
  template <class V>
  void follow(V&& velocity, double t, double dt, int substeps, double way) {
    const double part = dt / substeps;
    for (int s = 0; s < substeps; ++s) {
      stepper_.step(positions(), s * part, part, [&](const auto& x, double since, auto&& rate) {
        for (std::size_t p = 0; p < x.size(); ++p) {
          const Vec<D, T> u = velocity(x[p], t + way * since);
          rate.set(p, static_cast<T>(way) * u);
        }
      });
    }
  }

 private:
  std::array<std::array<T, size>, D> x_{};
  S<Columns<D, T>, Serial> stepper_;
};

/// Follows points along a velocity, and finds out in how many steps that is done to within an error.
template <template <class, class> class S, class T, int D>
class Paths {
 public:
  using Group = PathGroup<S, T, D>;

  /// Makes room for the threads of an execution.
  void fit(std::size_t workers) {
    if (group_.size() < workers) group_.resize(workers);
  }
  Group& group(std::size_t worker) { return group_[worker]; }

  /// Moves points from t to t + dt.
  template <class V, class E>
  void push(const Columns<D, T>& x, V&& velocity, double t, double dt, int substeps, const E& execution) {
    for_each_piece_by_worker(execution, x.size(), Group::size, [&](std::size_t w, std::size_t begin, std::size_t end) {
      const Columns<D, T> own = group_[w].positions();
      for (std::size_t k = 0; k < Group::size; ++k) own.set(k, x[std::min(begin + k, end - 1)]);
      group_[w].follow(velocity, t, dt, substeps, 1.0);
      for (std::size_t p = begin; p < end; ++p) x.set(p, own[p - begin]);
    });
  }
  /// Substeps are doubled until some of the points x come to within `path_error` spacings of where they belong, as the
  /// difference between the last two tells. \throws ValueError if no number of them does
  template <class V, class E>
  int substeps(const Columns<D, T>& x, double spacing, double path_error, V&& velocity, double t, double dt,
               const E& execution) {
    constexpr double gain = 1 << S<Columns<D, T>, Serial>::order;  // what a doubling makes the error smaller by
    const double allowed = path_error * spacing;
    push(probe(x, 0), velocity, t, dt, 1, execution);
    for (int substeps = 1; substeps < most_substeps; substeps *= 2) {
      push(probe(x, 1), velocity, t, dt, 2 * substeps, execution);
      const double difference = between_probes();
      // Velocities that are not finite are refused where their particles come from.
      if (!(difference > allowed)) return substeps;
      if (difference <= (gain - 1.0) * allowed) return 2 * substeps;
      probe_[0].swap(probe_[1]);
    }
    throw ValueError(message("paths near the interface are not known to ", path_error, " spacings after ",
                             most_substeps,
                             " steps of the stepper: the velocity is not smooth; take shorter steps or allow a "
                             "larger path_error, or say how many substeps to take"));
  }

 private:
  static constexpr int most_substeps = 4096;
  /// Points that are asked how many substeps it takes.
  static constexpr std::size_t probes = 2048;

  /// Takes some of the points x, spread over them, as probe number k.
  Columns<D, T> probe(const Columns<D, T>& x, std::size_t k) {
    const std::size_t pitch = std::max<std::size_t>(1, x.size() / probes);
    const std::size_t count = (x.size() + pitch - 1) / pitch;
    std::array<T*, D> first;
    for (int d = 0; d < D; ++d) {
      probe_[k][d].resize(count);
      first[d] = probe_[k][d].data();
    }
    const Columns<D, T> taken(first, count);
    for (std::size_t p = 0; p < count; ++p) taken.set(p, x[p * pitch]);
    return taken;
  }
  double between_probes() const {
    double difference = 0.0;
    for (std::size_t p = 0; p < probe_[0][0].size(); ++p) {
      for (int d = 0; d < D; ++d) {
        const double off = std::abs(static_cast<double>(probe_[1][d][p] - probe_[0][d][p]));
        difference = off <= difference ? difference : off;  // NaN stays
      }
    }
    return difference;
  }

  std::vector<Group> group_;
  std::array<std::array<AlignedVector<T>, D>, 2> probe_;  ///< places that two ways of following points come to
};

}  // namespace cambium::detail
