// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace bench {

/// Things whose times are to be compared. They take turns: a round runs each of them once, so that whatever slows the
/// machine down for a while slows all of them down. A turn is two runs, of which the second is timed: it finds caches
/// as calls in a loop do, not as the others left them. Numbers are medians over rounds of what one round gives.
class Contest {
 public:
  /// Seconds that each entrant took in one round.
  using Round = std::vector<double>;
  /// A number of one round.
  using Counter = std::function<double(const Round&)>;
  using Clock = double (*)();

  explicit Contest(Clock clock) : clock_(clock) {}

  /// \param before  work outside the measured time, each time before `run`
  /// \return number of the entrant in a Round
  std::size_t add(
      std::string name, std::function<void()> run, std::function<void()> before = [] {}) {
    entrants_.push_back({std::move(name), std::move(run), std::move(before), {}});
    return entrants_.size() - 1;
  }
  /// Adds a counter to the row of an entrant.
  void count(std::size_t entrant, std::string name, Counter counter) {
    entrants_[entrant].counters.emplace_back(std::move(name), std::move(counter));
  }

  /// Makes a Google Benchmark of each entrant. The contest itself runs when the first of them does, and frees then what
  /// the entrants hold.
  static void enter(const std::shared_ptr<Contest>& contest, std::size_t rounds) {
    for (std::size_t i = 0; i < contest->entrants_.size(); ++i) {
      benchmark::RegisterBenchmark(contest->entrants_[i].name.c_str(),
                                   [=](benchmark::State& state) {
                                     contest->run(rounds);
                                     contest->report(i, state);
                                   })
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond)
          ->Iterations(static_cast<benchmark::IterationCount>(rounds));
    }
  }

 private:
  struct Entrant {
    std::string name;
    std::function<void()> run;
    std::function<void()> before;
    std::vector<std::pair<std::string, Counter>> counters;
  };

  void run(std::size_t rounds) {
    if (!rounds_.empty()) return;
    for (std::size_t r = 0; r < rounds; ++r) {
      Round round;
      for (const Entrant& entrant : entrants_) {
        entrant.before();
        entrant.run();
        entrant.before();
        const double start = clock_();
        entrant.run();
        round.push_back(clock_() - start);
      }
      rounds_.push_back(round);
    }
    for (Entrant& entrant : entrants_) entrant.run = entrant.before = nullptr;
  }

  void report(std::size_t i, benchmark::State& state) const {
    std::size_t r = 0;
    for (auto _ : state) state.SetIterationTime(rounds_[r++ % rounds_.size()][i]);
    for (const auto& [name, counter] : entrants_[i].counters) {
      std::vector<double> values;
      for (const Round& round : rounds_) values.push_back(counter(round));
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      state.counters[name] = *middle;
    }
  }

  Clock clock_;
  std::vector<Entrant> entrants_;
  std::vector<Round> rounds_;
};

}  // namespace bench
