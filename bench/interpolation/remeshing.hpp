// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <cambium/interpolation.hpp>

#include "interpolation/options.hpp"
#include "support/clock.hpp"
#include "support/contest.hpp"
#include "support/scene.hpp"

namespace bench {

/// Remeshing of particles that left the nodes of a 3D lattice by three shears one after another: a displacement that
/// keeps volume and whose inverse is known, so that the remeshed strengths have an exact value.
struct Shears {
  double amplitude;

  double shift(double x) const { return amplitude * std::sin(2.0 * std::numbers::pi * x); }
  cambium::Vec<3> operator()(cambium::Vec<3> x) const {
    x[0] += shift(x[1]);
    x[2] += shift(x[0]);
    x[1] += shift(x[2]);
    return x;
  }
  cambium::Vec<3> inverse(cambium::Vec<3> x) const {
    x[1] -= shift(x[2]);
    x[2] -= shift(x[0]);
    x[0] -= shift(x[1]);
    return x;
  }
};

inline double density(const cambium::Vec<3>& x) {
  double product = 1.0;
  for (int d = 0; d < 3; ++d) product *= std::exp(std::sin(2.0 * std::numbers::pi * x[d]));
  return product;
}

template <class K, class Strategy>
class RemeshRun {
 public:
  RemeshRun(std::ptrdiff_t cells, double displacement)
      : lattice_(cambium::Lattice<3>::periodic_box(cambium::Box<3>::cube(), cells)),
        shears_{displacement},
        start_(lattice_.size()),
        particles_(lattice_.size()),
        strength_(particles_.add<double>("strength")) {
    start_.add<double>("strength");
    for (std::size_t i = 0; i < lattice_.size(); ++i) {
      const cambium::Vec<3> x = lattice_.position(lattice_.node(i));
      start_.positions().set(i, lattice_.domain().wrap(shears_(x)));
      start_[strength_][i] = density(x);
    }
  }
  /// Puts the particles where they are before remeshing, into the same memory.
  void reset() {
    for (int d = 0; d < 3; ++d)
      std::ranges::copy(start_.positions().column(d), particles_.positions().column(d).begin());
    std::ranges::copy(start_[strength_], particles_[strength_].begin());
  }
  void operator()() { remesh_(particles_, lattice_, strength_); }
  /// Root mean square, relative.
  double error() const {
    double difference = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < lattice_.size(); ++i) {
      const double exact = density(shears_.inverse(lattice_.position(lattice_.node(i))));
      difference += std::pow(particles_[strength_][i] - exact, 2);
      size += exact * exact;
    }
    return std::sqrt(difference / size);
  }

 private:
  cambium::Lattice<3> lattice_;
  Shears shears_;
  cambium::Particles<3> start_;
  cambium::Particles<3> particles_;
  cambium::Attribute<double> strength_;
  cambium::Remesher<K, Strategy, cambium::Serial> remesh_;
};

template <class K>
void enter_remeshing(const char* kernel, const Options& options) {
  const std::ptrdiff_t cells = options.cells_3d;
  const double displacement = 2.0 / static_cast<double>(cells);
  const std::string prefix = cambium::detail::message("remesh/", kernel, "/3D/");
  const auto contest = std::make_shared<Contest>(cpu_seconds);
  const auto tensor = lazily<RemeshRun<K, cambium::Tensor>>(cells, displacement);
  const auto split = lazily<RemeshRun<K, cambium::Split>>(cells, displacement);
  const std::size_t one = contest->add(
      prefix + "tensor", [=] { (**tensor)(); }, [=] { (*tensor)->reset(); });
  const std::size_t other = contest->add(
      prefix + "split", [=] { (**split)(); }, [=] { (*split)->reset(); });
  const double particles = std::pow(static_cast<double>(cells), 3);
  for (const std::size_t i : {one, other}) {
    contest->count(i, "ns_per_particle", [=](const auto& round) { return 1e9 * round[i] / particles; });
  }
  contest->count(other, "speedup_over_tensor", [=](const auto& round) { return round[one] / round[other]; });
  Contest::enter(contest, options.rounds);
}

template <class K, class Strategy>
double remeshing_error(std::ptrdiff_t cells) {
  RemeshRun<K, Strategy> run(cells, 2.0 / static_cast<double>(cells));
  run.reset();
  run();
  return run.error();
}

template <class K>
void enter_remeshing_error(const char* kernel, const Options& options) {
  const std::string row = cambium::detail::message("remesh_error/", kernel, "/3D");
  benchmark::RegisterBenchmark(
      row.c_str(),
      [=](benchmark::State& state) {
        for (auto _ : state) {
          double tensor = 0.0;
          double split = 0.0;
          double ratio = 0.0;
          std::ptrdiff_t last = 0;
          for (const std::ptrdiff_t cells : options.error_cells) {
            const double refinement = last > 0 ? std::log(static_cast<double>(cells) / static_cast<double>(last)) : 0.0;
            const double tensor_before = std::exchange(tensor, remeshing_error<K, cambium::Tensor>(cells));
            const double split_before = std::exchange(split, remeshing_error<K, cambium::Split>(cells));
            ratio = split / tensor;
            state.counters[cambium::detail::message("tensor_", cells)] = tensor;
            state.counters[cambium::detail::message("split_", cells)] = split;
            if (last > 0) {
              state.counters["order_tensor"] = std::log(tensor_before / tensor) / refinement;
              state.counters["order_split"] = std::log(split_before / split) / refinement;
            }
            last = cells;
          }
          state.counters["split_error_over_tensor"] = ratio;
        }
      })
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
}

}  // namespace bench
