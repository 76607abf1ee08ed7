// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdio>

namespace tumour {

/// Says now and then how far a run is and how long it will take.
class Progress {
 public:
  explicit Progress(double end) : end_(end), start_(Clock::now()), last_(start_) {}

  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  /// One line, if it is due: every five seconds.
  void tell(int step, double time, double dt, double volume) {
    if (std::chrono::duration<double>(Clock::now() - last_).count() < 5.0) return;
    last_ = Clock::now();
    std::printf("step %5d   t = %.4f of %g   dt = %.2e   volume %.5g   %3.0f%%, about %.0f s left\n", step, time, end_,
                dt, volume, 100.0 * time / end_, seconds() * (end_ - time) / time);
    std::fflush(stdout);
  }

 private:
  using Clock = std::chrono::steady_clock;
  double end_;
  Clock::time_point start_, last_;
};

}  // namespace tumour
