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
T make_model(const Options& options, const Checkpoint* saved) {
  constexpr int D = T::dimension;
  using cambium::Lattice;
  using cambium::Vec;
  const cambium::Box<D> box{Vec<D>::constant(-0.5 * options.box), Vec<D>::constant(0.5 * options.box)};
  const auto lattice = options.outside == "periodic" ? Lattice<D>::periodic_box(box, options.cells)
                                                     : Lattice<D>::bounded_box(box, options.cells);
  typename T::Params params;
  params.parameters = options.parameters;
  params.courant = options.courant;
  if (saved) return T::restored(lattice, saved->state, params, {options.threads});
  return T(lattice, shape_of<D>(options.shape), params, {options.threads});
}

/// Steps until one of the times, or why not.
template <class T>
class Growing {
 public:
  Growing(const Options& options, const std::string& configuration, const StopRequests& stop, const Checkpoint* saved)
      : tumour_(make_model<T>(options, saved)),
        record_(options, configuration, saved),
        own_(saved ? own_state(saved->state) : Own{}),
        progress_(options.at.back(), tumour_.time(), own_.seconds),
        checkpoints_(options.checkpoint),
        stop_(stop),
        most_steps_(options.smoke ? 2 : -1) {
    if (saved) {
      series_.resume(tumour_, own_.expected);
      std::printf("goes on at t = %.6g after %d steps\n", tumour_.time(), own_.steps);
    } else {
      record_.add(series_.take(tumour_, {}), 0);
      show();
    }
  }

  nlohmann::json operator()(const std::vector<double>& times) {
    std::string ended;
    try {
      if (own_.steps > 0 && tumour_.extinct()) ended = died_out;  // what it goes on from is over
      for (const double time : times) {
        if (!ended.empty()) break;
        if (tumour_.time() - time > 1e-12 * time) continue;  // was before what it goes on from
        ended = step_to(time);
        if (!ended.empty()) save();  // what goes on has no picture here
        if (own_.shown != tumour_.time() && !tumour_.extinct()) show();
      }
      if (ended.empty()) save();
    } catch (const cambium::Error& error) {
      finish(std::string("error: ") + error.what());
      throw;
    }
    finish(ended.empty() ? "the last time is reached" : ended);
    return record_.report();
  }

 private:
  static constexpr const char* died_out = "the tumour has died out";

  /// State of the program beside the tumour's.
  struct Own {
    int steps = 0;
    double shown = -1.0;  ///< time of the last picture
    double expected = 0.0;
    double seconds = 0.0;

    template <class Self, class Archive>
    static void visit(Self& self, Archive& archive) {
      archive("run.steps", self.steps);
      archive("run.shown", self.shown);
      archive("run.expected", self.expected);
      archive("run.seconds", self.seconds);
    }
  };
  static Own own_state(const cambium::Snapshot& state) {
    Own own;
    cambium::SnapshotReader reader(state);
    Own::visit(own, reader);
    return own;
  }

  /// Empty, or why the run is over before.
  std::string step_to(double time) {
    while (time - tumour_.time() > 1e-12 * time) {
      if (stop_.arrived()) return "stopped by a signal";
      if (own_.steps == most_steps_) return "a few steps were asked for";
      // The last two steps before a picture are of about one length: no tiny ones.
      const double rest = time - tumour_.time();
      const double longest = tumour_.next_step(rest).dt;
      try {
        const cambium::TumourStep step = tumour_.step(longest < rest && 2.0 * longest > rest ? 0.5 * rest : rest);
        ++own_.steps;
        if (step.extinct) return died_out;
        record_.add(series_.take(tumour_, step), own_.steps);
      } catch (const cambium::TumourAtWallError& error) {
        return error.what();
      }
      if (checkpoints_.due()) save();
      progress_.tell(own_.steps, tumour_.time(), series_.last().step.dt, series_.last().measures.volume);
    }
    return "";
  }
  void show() {
    const auto& row = series_.last();
    record_.picture(tumour_, row);
    own_.shown = tumour_.time();
    std::printf(
        "t = %-7.4g volume %.6g  area %.6g  parts %zu  interfaces %zu  necrotic %.4g  imbalance %.1e  (%d steps, "
        "%.1f s)\n",
        row.time, row.measures.volume, row.measures.area, row.measures.inside_components,
        row.measures.interface_components, row.budget.necrotic, row.imbalance(), own_.steps, progress_.seconds());
    std::fflush(stdout);
  }
  void save() {
    own_.expected = series_.last().expected;
    Own now = own_;
    now.seconds = progress_.seconds();
    cambium::Snapshot state = tumour_.save();
    cambium::SnapshotWriter writer(state);
    Own::visit(now, writer);
    record_.checkpoint(std::move(state));
    checkpoints_.done();
  }
  void finish(const std::string& ended) {
    record_.finish(tumour_, ended, own_.steps, progress_.seconds());
    std::printf("%s (t = %.6g, %d steps, %.1f s)\n", ended.c_str(), tumour_.time(), own_.steps, progress_.seconds());
  }

  T tumour_;
  Record<T> record_;
  Series<T> series_;
  Own own_;
  Progress progress_;
  Checkpoints checkpoints_;
  const StopRequests& stop_;
  int most_steps_;
};

}  // namespace detail

template <int D, class Outside>
nlohmann::json run(const Options& options, const std::string& configuration, const StopRequests& stop,
                   const Checkpoint* saved) {
  return detail::Growing<Model<D, Outside>>(options, configuration, stop, saved)(options.at);
}

}  // namespace tumour
