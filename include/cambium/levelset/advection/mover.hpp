// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include <cambium/core/columns.hpp>
#include <cambium/parallel/execution.hpp>
#include <cambium/time/state_adaptors.hpp>

namespace cambium::detail {

/// Moves points with a flow by stepper S. Points go in groups that fit the cache, each on one thread: buffers are made
/// once, and the bits do not depend on the number of threads.
template <class T, int D, template <class, class> class S>
class Mover {
 public:
  /// x := its place at t + dt, by `substeps` steps of the stepper.
  /// \param factor    factor(p) times the velocity moves point p; where it is zero, the velocity is not asked for
  /// \param velocity  velocity(Vec<D, T> x, double time) -> Vec<D, T>, called by several threads
  template <class F, class V, Execution E>
  void operator()(const Columns<D, T>& x, F&& factor, V&& velocity, double t, double dt, int substeps,
                  const E& execution) {
    while (groups_.size() < static_cast<std::size_t>(execution.count())) groups_.push_back(std::make_unique<Group>());
    for_each_piece_by_worker(execution, x.size(), size, [&](std::size_t w, std::size_t begin, std::size_t end) {
      Group& group = *groups_[w];
      bool any = false;
      for (std::size_t k = 0; k < size; ++k) {
        // The last group is filled up with its last point, at rest.
        const std::size_t p = std::min(begin + k, end - 1);
        group.positions().set(k, x[p]);
        group.factor[k] = begin + k < end ? static_cast<T>(factor(p)) : T(0);
        any |= group.factor[k] != T(0);
      }
      if (!any) return;
      move(group, velocity, t, dt, substeps);
      for (std::size_t p = begin; p < end; ++p) {
        if (group.factor[p - begin] != T(0)) x.set(p, group.positions()[p - begin]);
      }
    });
  }

 private:
  static constexpr std::size_t size = 64;

  struct Group {
    Group() : stepper(positions(), Serial{}) {}
    Columns<D, T> positions() {
      std::array<T*, D> first;
      for (int d = 0; d < D; ++d) first[d] = x[d].data();
      return {first, size};
    }
    std::array<std::array<T, size>, D> x{};
    std::array<T, size> factor{};
    S<Columns<D, T>, Serial> stepper;
  };

  template <class V>
  static void move(Group& group, V&& velocity, double t, double dt, int substeps) {
    const double part = dt / substeps;
    for (int s = 0; s < substeps; ++s) {
      group.stepper.step(group.positions(), t + s * part, part, [&](const auto& x, double time, auto&& rate) {
        for (std::size_t p = 0; p < size; ++p) {
          Vec<D, T> u{};
          if (group.factor[p] != T(0)) u = group.factor[p] * velocity(x[p], time);
          rate.set(p, u);
        }
      });
    }
  }

  std::vector<std::unique_ptr<Group>> groups_;
};

}  // namespace cambium::detail
