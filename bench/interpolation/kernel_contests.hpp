// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmark/benchmark.h>
#include <cmath>
#include <memory>
#include <string>

#include <cambium/core/error.hpp>
#include <cambium/kernels.hpp>

#include "interpolation/options.hpp"
#include "interpolation/runs.hpp"
#include "support/clock.hpp"
#include "support/contest.hpp"
#include "support/peak.hpp"
#include "support/scene.hpp"

namespace bench {

/// Nodes that a particle gives to or takes from.
template <class K, int D>
constexpr double nodes_per_particle() {
  double nodes = 1.0;
  for (int d = 0; d < D; ++d) nodes *= K::support;
  return nodes;
}

/// Operations a particle needs: a multiply-add for each node and component, Horner's rule for each weight, in 3D the
/// products of the weights of two axes.
template <class K, int D, int C>
constexpr double flops_per_particle() {
  return 2.0 * nodes_per_particle<K, D>() * C + 2.0 * D * K::support * cambium::Taps<K>::degree +
         (D == 3 ? K::support * K::support : 0);
}

/// The contest of all variants of one kernel, dimension and way on one thread: both scalar types, one and three
/// components, both orders, plain loops, a user's loop.
template <class K, int D>
class InterpolationContest {
 public:
  InterpolationContest(const char* kernel, Way way, const Options& options)
      : way_(way),
        options_(options),
        prefix_(cambium::detail::message(name(way), "/", kernel, "/", D, "D/")),
        particles_(std::pow(static_cast<double>(options.cells<D>()), D)) {}

  /// \return entrant of one component, sorted
  template <class T>
  std::size_t add() {
    const std::string scalar = prefix_ + scalar_name<T> + "/";
    const auto sorted = lazily<Cloud<D, T>>(options_.cells<D>(), Order::sorted);
    const auto random = lazily<Cloud<D, T>>(options_.cells<D>(), Order::random);
    const std::size_t peak = add_peak<T>(scalar);
    const std::size_t one = add_library<T, 1, true>(scalar + "1/sorted", sorted, peak);
    const std::size_t three = add_library<T, 3, true>(scalar + "3/sorted", sorted, peak);
    compare(three, "ratio_to_one_component", one);
    compare(add_library<T, 1, false>(scalar + "1/unplaced", sorted, peak), "ratio_to_sorted", one);
    compare(add_library<T, 1, false>(scalar + "1/random", random, peak), "ratio_to_sorted", one);
    compare(add_library<T, 3, false>(scalar + "3/random", random, peak), "ratio_to_sorted", three);
    compare(add_loop<PlainRun<CompiledBy::build, K, D, T>>(scalar + "1/plain_build", sorted), "ratio_to_library", one);
    if constexpr (PLAIN_LOOP_CLANG) {
      compare(add_loop<PlainRun<CompiledBy::clang, K, D, T>>(scalar + "1/plain_clang", sorted), "ratio_to_library",
              one);
    }
    compare(add_loop<UserRun<K, D, T>>(scalar + "1/user", sorted), "ratio_to_library", one);
    return one;
  }
  void compare(std::size_t entrant, const char* what, std::size_t with) {
    contest_->count(entrant, what, [=](const auto& round) { return round[entrant] / round[with]; });
  }
  void enter() { Contest::enter(contest_, options_.rounds); }

 private:
  template <class T>
  std::size_t add_peak(const std::string& scalar) {
    const std::size_t steps = options_.peak_steps;
    const std::size_t peak = contest_->add(scalar + "peak", [=] { benchmark::DoNotOptimize(FmaPeak<T>::run(steps)); });
    const double flops = FmaPeak<T>::flops_per_step * static_cast<double>(steps);
    contest_->count(peak, "gflops", [=](const auto& round) { return 1e-9 * flops / round[peak]; });
    return peak;
  }
  template <class T, int C, bool placed>
  std::size_t add_library(const std::string& row, std::shared_ptr<Lazy<Cloud<D, T>>> cloud, std::size_t peak) {
    const auto run = lazily<LibraryRun<K, D, T, C, placed>>(cloud);
    const std::size_t i = contest_->add(row, [=, way = way_] { (**run)(way, 1); });
    add_rates(i);
    const double flops = particles_ * flops_per_particle<K, D, C>();
    const double peak_flops = FmaPeak<T>::flops_per_step * static_cast<double>(options_.peak_steps);
    contest_->count(i, "fraction_of_peak",
                    [=](const auto& round) { return flops / round[i] / (peak_flops / round[peak]); });
    return i;
  }
  template <class Run, class Source>
  std::size_t add_loop(const std::string& row, const Source& cloud) {
    const auto run = lazily<Run>(cloud);
    const std::size_t i = contest_->add(row, [=, way = way_] { (**run)(way); });
    add_rates(i);
    return i;
  }
  void add_rates(std::size_t i) {
    const double particles = particles_;
    contest_->count(i, "ns_per_particle", [=](const auto& round) { return 1e9 * round[i] / particles; });
    contest_->count(i, "node_updates_per_second",
                    [=](const auto& round) { return particles * nodes_per_particle<K, D>() / round[i]; });
  }

  Way way_;
  Options options_;
  std::string prefix_;
  double particles_;
  std::shared_ptr<Contest> contest_ = std::make_shared<Contest>(cpu_seconds);
};

/// One thread against two, beside arithmetic in which each thread does for itself what one thread does alone.
template <class K, int D>
class ThreadsContest {
 public:
  ThreadsContest(const char* kernel, Way way, const Options& options)
      : way_(way),
        options_(options),
        prefix_(cambium::detail::message("threads/", name(way), "/", kernel, "/", D, "D/")) {
    const auto arithmetic = [steps = options.peak_steps](int threads) {
      cambium::for_each_piece(cambium::OpenMP{threads}, static_cast<std::size_t>(threads), 1,
                              [&](std::size_t, std::size_t) { benchmark::DoNotOptimize(FmaPeak<double>::run(steps)); });
    };
    sum_one_ = contest_->add(prefix_ + "arithmetic/1", [=] { arithmetic(1); });
    sum_two_ = contest_->add(prefix_ + "arithmetic/2", [=] { arithmetic(2); });
    contest_->count(sum_two_, "gain", arithmetic_gain());
  }

  /// Both orders of one scalar type and number of components.
  template <class T, int C>
  void add() {
    add<T, C, true>(Order::sorted);
    add<T, C, false>(Order::random);
  }
  void enter() { Contest::enter(contest_, options_.rounds); }

 private:
  /// Each thread of `arithmetic/2` does as much as the one of `arithmetic/1`.
  Contest::Counter arithmetic_gain() const {
    return [one = sum_one_, two = sum_two_](const auto& round) { return 2.0 * round[one] / round[two]; };
  }
  template <class T, int C, bool placed>
  void add(Order order) {
    const auto cloud = lazily<Cloud<D, T>>(options_.cells<D>(), order);
    const auto run = lazily<LibraryRun<K, D, T, C, placed>>(cloud);
    const std::string row = cambium::detail::message(prefix_, scalar_name<T>, "/", C, placed ? "/sorted/" : "/random/");
    const std::size_t one = contest_->add(row + "1", [=, way = way_] { (**run)(way, 1); });
    const std::size_t two = contest_->add(row + "2", [=, way = way_] { (**run)(way, 2); });
    const Contest::Counter gain = [=](const auto& round) { return round[one] / round[two]; };
    contest_->count(two, "gain", gain);
    contest_->count(two, "gain_over_arithmetic",
                    [gain, of = arithmetic_gain()](const auto& round) { return gain(round) / of(round); });
  }

  Way way_;
  Options options_;
  std::string prefix_;
  std::shared_ptr<Contest> contest_ = std::make_shared<Contest>(wall_seconds);
  std::size_t sum_one_ = 0;
  std::size_t sum_two_ = 0;
};

template <class K, int D>
void enter_dimension(const char* kernel, Way way, const Options& options) {
  InterpolationContest<K, D> contest(kernel, way, options);
  const std::size_t wide = contest.template add<double>();
  contest.compare(contest.template add<float>(), "ratio_to_double", wide);
  contest.enter();
  ThreadsContest<K, D> threads(kernel, way, options);
  threads.template add<double, 1>();
  threads.template add<double, 3>();
  threads.template add<float, 1>();
  threads.template add<float, 3>();
  threads.enter();
}

template <class K>
void enter_kernel(const char* kernel, const Options& options) {
  for (const Way way : {Way::p2m, Way::m2p}) {
    enter_dimension<K, 2>(kernel, way, options);
    enter_dimension<K, 3>(kernel, way, options);
  }
}

}  // namespace bench
