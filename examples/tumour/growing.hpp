// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "model.hpp"
#include "progress.hpp"
#include "record.hpp"
#include "run.hpp"
#include "shape.hpp"

namespace tumour {
namespace detail {

template <class T>
T make_model(const Options& options) {
  constexpr int D = T::dimension;
  using cambium::Lattice;
  using cambium::Vec;
  const cambium::Box<D> box{Vec<D>::constant(-0.5 * options.box), Vec<D>::constant(0.5 * options.box)};
  const auto lattice = options.outside == "periodic" ? Lattice<D>::periodic_box(box, options.cells)
                                                     : Lattice<D>::bounded_box(box, options.cells);
  typename T::Params params;
  params.parameters = options.parameters;
  params.courant = options.courant;
  return T(lattice, shape_of<D>(options.shape), params, {options.threads});
}

/// Steps until one of the times, or why not.
template <class T>
class Growing {
 public:
  Growing(const Options& options, const std::string& configuration, const StopRequests& stop)
      : tumour_(make_model<T>(options)),
        record_(options, configuration),
        progress_(options.at.back()),
        stop_(stop),
        most_steps_(options.smoke ? 2 : -1) {
    record_.add(series_.take(tumour_, {}), 0);
    show();
  }

  nlohmann::json operator()(const std::vector<double>& times) {
    std::string ended;
    try {
      for (const double time : times) {
        ended = step_to(time);
        if (shown_ != tumour_.time() && !tumour_.extinct()) show();
        if (!ended.empty()) break;
      }
    } catch (const cambium::Error& error) {
      finish(std::string("error: ") + error.what());
      throw;
    }
    finish(ended.empty() ? "the last time is reached" : ended);
    return record_.report();
  }

 private:
  /// Empty, or why the run is over before.
  std::string step_to(double time) {
    while (time - tumour_.time() > 1e-12 * time) {
      if (stop_.arrived()) return "stopped by a signal";
      if (steps_ == most_steps_) return "a few steps were asked for";
      // The last two steps before a picture are of about one length: no tiny ones.
      const double rest = time - tumour_.time();
      const double longest = tumour_.next_step(rest).dt;
      try {
        const cambium::TumourStep step = tumour_.step(longest < rest && 2.0 * longest > rest ? 0.5 * rest : rest);
        ++steps_;
        if (step.extinct) return "the tumour has died out";
        record_.add(series_.take(tumour_, step), steps_);
      } catch (const cambium::TumourAtWallError& error) {
        return error.what();
      }
      progress_.tell(steps_, tumour_.time(), series_.last().step.dt, series_.last().measures.volume);
    }
    return "";
  }
  void show() {
    const auto& row = series_.last();
    record_.picture(tumour_, row);
    shown_ = tumour_.time();
    std::printf(
        "t = %-7.4g volume %.6g  area %.6g  parts %zu  interfaces %zu  necrotic %.4g  imbalance %.1e  (%d steps, "
        "%.1f s)\n",
        row.time, row.measures.volume, row.measures.area, row.measures.inside_components,
        row.measures.interface_components, row.budget.necrotic, row.imbalance(), steps_, progress_.seconds());
    std::fflush(stdout);
  }
  void finish(const std::string& ended) {
    record_.finish(tumour_, ended, steps_, progress_.seconds());
    std::printf("%s (t = %.6g, %d steps, %.1f s)\n", ended.c_str(), tumour_.time(), steps_, progress_.seconds());
  }

  T tumour_;
  Record<T> record_;
  Series<T> series_;
  Progress progress_;
  const StopRequests& stop_;
  int steps_ = 0;
  int most_steps_;
  double shown_ = -1.0;
};

}  // namespace detail

template <int D, class Outside>
nlohmann::json run(const Options& options, const std::string& configuration, const StopRequests& stop) {
  return detail::Growing<Model<D, Outside>>(options, configuration, stop)(options.at);
}

}  // namespace tumour
