// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdio>

namespace tumour {

/// Says now and then how far a run is and how long it will take.
class Progress {
 public:
  /// \param begin  time that a run goes on from, after so many seconds
  Progress(double end, double begin, double seconds)
      : end_(end), begin_(begin), before_(seconds), start_(Clock::now()), last_(start_) {}

  /// That the run has taken.
  double seconds() const { return before_ + since_start(); }
  /// One line, if it is due: every five seconds.
  void tell(int step, double time, double dt, double volume) {
    if (std::chrono::duration<double>(Clock::now() - last_).count() < 5.0) return;
    last_ = Clock::now();
    std::printf("step %5d   t = %.4f of %g   dt = %.2e   volume %.5g   %3.0f%%, about %.0f s left\n", step, time, end_,
                dt, volume, 100.0 * time / end_, since_start() * (end_ - time) / (time - begin_));
    std::fflush(stdout);
  }

 private:
  using Clock = std::chrono::steady_clock;
  double since_start() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  double end_, begin_, before_;
  Clock::time_point start_, last_;
};

/// When the next checkpoint is due: so many seconds after the last.
class Checkpoints {
 public:
  explicit Checkpoints(double seconds) : seconds_(seconds), last_(Clock::now()) {}

  bool due() const { return std::chrono::duration<double>(Clock::now() - last_).count() >= seconds_; }
  void done() { last_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  double seconds_;
  Clock::time_point last_;
};

}  // namespace tumour
