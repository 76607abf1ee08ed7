// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a node of the band costs, in time and in memory, on lattices from 64^3 on: a ball of radius 0.3 in the unit box
// is built, moved by steps of four spacings at most and made a distance again. And what two threads gain, as a share
// of what a loop of multiply-adds, which touches no memory, gains from them in the same minutes.
//
//     level_set_scaling --cells 64 128 256 512 1024 --json docs/charts/level_set_scaling.json
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <sys/resource.h>
#include <vector>

#include <cambium/levelset.hpp>

#include "support/clock.hpp"
#include "support/command.hpp"
#include "support/peak.hpp"

using namespace cambium;

namespace bench {
namespace {

constexpr double radius = 0.3;

/// Round an axis through the middle of the box and along it: no point of the ball moves faster than 0.33.
Vec<3> velocity(const Vec<3>& x, double) { return {0.5 - x[1], x[0] - 0.5, 0.1}; }

template <class F>
double seconds(F&& f) {
  const double start = wall_seconds();
  f();
  return wall_seconds() - start;
}

struct Row {
  std::ptrdiff_t cells = 0;
  std::size_t nodes = 0;                                              ///< in the band
  std::size_t stored = 0;                                             ///< in blocks
  double build = 0.0, step = 0.0, reinitialise = 0.0, measure = 0.0;  ///< nanoseconds a band node
  double volume = 0.0;                                                ///< relative error after the step
  double gigabytes = 0.0;                                             ///< most memory that the program had so far
};

std::size_t band_nodes(const NarrowBand<double, 3>& band) {
  std::size_t nodes = 0;
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    nodes += static_cast<std::size_t>(
        std::ranges::count_if(band.values().block(b), [&](double phi) { return band.in_band(phi); }));
  }
  return nodes;
}

LevelSet<ClosestPoint, 3> make_ball(std::ptrdiff_t cells, const OpenMP& threads) {
  const Lattice<3> lattice = Lattice<3>::bounded_box(Box<3>::cube(), cells);
  return LevelSet<ClosestPoint, 3>(lattice, Ball<3>({0.48, 0.5, 0.5}, radius), {}, threads);
}
double four_spacings(std::ptrdiff_t cells) { return 4.0 / (0.33 * static_cast<double>(cells)); }

/// Best of so many calls that the smallest lattices, too, give times to rely on.
template <class F>
double best_seconds(std::size_t nodes, F&& f) {
  double best = seconds(f);
  for (std::size_t calls = 1; calls * nodes < 1000000; ++calls) best = std::min(best, seconds(f));
  return best;
}

Row measure_row(std::ptrdiff_t cells, const OpenMP& threads) {
  Row row{.cells = cells};
  const double start = wall_seconds();
  LevelSet<ClosestPoint, 3> ball = make_ball(cells, threads);
  row.build = wall_seconds() - start;
  row.nodes = band_nodes(ball.band());
  row.stored = ball.band().blocks() * NarrowBand<double, 3>::volume;
  Backward<> advection;
  double way = 1.0;  // forth and back, so that the ball stays in the box
  row.step = best_seconds(row.nodes, [&] {
    const auto to_and_fro = [&](const Vec<3>& x, double t) { return way * velocity(x, t); };
    advection.step(ball, to_and_fro, 0.0, four_spacings(cells), threads);
    way = -way;
  });
  row.reinitialise = best_seconds(row.nodes, [&] { ball.reinitialise(threads); });
  const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
  row.measure = best_seconds(row.nodes, [&] { row.volume = measures(ball.band()).volume / exact - 1.0; });
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  row.gigabytes = static_cast<double>(usage.ru_maxrss) * 1024.0 / 1e9;
  for (double* time : {&row.build, &row.step, &row.reinitialise, &row.measure}) {
    *time *= 1e9 / static_cast<double>(row.nodes);
  }
  return row;
}

double arithmetic(const OpenMP& threads, std::size_t steps) {
  constexpr std::size_t pieces = 64;
  std::vector<double> result(pieces);
  return seconds([&] {
    for_each_piece(threads, pieces, 1, [&](std::size_t k, std::size_t) { result[k] = FmaPeak<double>::run(steps); });
  });
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Gain {
  double step = 0.0, reinitialise = 0.0, arithmetic = 0.0;  ///< time of one thread over that of two
};

Gain measure_gain(std::ptrdiff_t cells, std::size_t rounds, std::size_t peak_steps) {
  LevelSet<ClosestPoint, 3> ball = make_ball(cells, OpenMP{});
  Backward<> advection;
  double t = 0.0;
  const double dt = four_spacings(cells);
  const auto reinitialise = [&](const OpenMP& threads) { return seconds([&] { ball.reinitialise(threads); }); };
  std::vector<double> of_step, of_reinitialise, of_arithmetic;
  for (std::size_t r = 0; r < rounds; ++r, t += dt) {
    const OpenMP one{1}, two{2};
    // Back and forth, so that the ball stays in the box.
    const double way = r % 2 == 0 ? 1.0 : -1.0;
    const auto back_and_forth = [&](const Vec<3>& x, double time) { return way * velocity(x, time); };
    LevelSet<ClosestPoint, 3> other = ball;
    const double alone = seconds([&] { advection.step(ball, back_and_forth, t, dt, one); });
    of_step.push_back(alone / seconds([&] { advection.step(other, back_and_forth, t, dt, two); }));
    const double reinit_alone = reinitialise(one);
    of_reinitialise.push_back(reinit_alone / reinitialise(two));
    const double arithmetic_alone = arithmetic(one, peak_steps);
    of_arithmetic.push_back(arithmetic_alone / arithmetic(two, peak_steps));
  }
  return {median(of_step), median(of_reinitialise), median(of_arithmetic)};
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  using namespace bench;
  std::vector<std::ptrdiff_t> cells{64, 128};
  std::ptrdiff_t gain_cells = 96;
  std::size_t rounds = 5, peak_steps = 400000;
  std::string json;
  CLI::App app("Time and memory of a level set for each node of its band, and what two threads gain");
  app.add_option("--cells", cells, "cells along an axis, one run for each, ascending");
  app.add_option("--gain-cells", gain_cells, "cells along an axis where threads are compared");
  app.add_option("--rounds", rounds, "comparisons of threads")->check(CLI::PositiveNumber);
  app.add_option("--peak-steps", peak_steps, "length of the loop of multiply-adds");
  app.add_option("--json", json, "write the figures to this file");
  CLI11_PARSE(app, argc, argv);

  nlohmann::json rows = nlohmann::json::array();
  bool good = true;
  std::printf("%5s %10s %8s %7s %7s %7s %8s %9s %9s\n", "cells", "band nodes", "stored/", "build", "step", "reinit",
              "measures", "volume", "GB");
  for (const auto n : cells) {
    const Row r = measure_row(n, OpenMP{1});
    std::printf("%5td %10zu %8.2f %7.0f %7.0f %7.0f %8.0f %9.1e %9.3f\n", n, r.nodes,
                static_cast<double>(r.stored) / static_cast<double>(r.nodes), r.build, r.step, r.reinitialise,
                r.measure, r.volume, r.gigabytes);
    std::fflush(stdout);
    rows.push_back({{"cells", n},
                    {"band_nodes", r.nodes},
                    {"stored_nodes", r.stored},
                    {"build_ns", r.build},
                    {"step_ns", r.step},
                    {"reinitialise_ns", r.reinitialise},
                    {"measures_ns", r.measure},
                    {"volume_error", r.volume},
                    {"gigabytes", r.gigabytes}});
    good &= r.gigabytes < 4.295 && std::abs(r.volume) < 5e-5;
  }
  const Gain gain = measure_gain(gain_cells, rounds, peak_steps);
  std::printf("two threads: step %.2f, reinitialisation %.2f, arithmetic %.2f; share %.2f and %.2f\n", gain.step,
              gain.reinitialise, gain.arithmetic, gain.step / gain.arithmetic, gain.reinitialise / gain.arithmetic);
  if (!json.empty()) {
    const nlohmann::json threads{{"step", gain.step},
                                 {"reinitialise", gain.reinitialise},
                                 {"arithmetic", gain.arithmetic},
                                 {"cells", gain_cells}};
    bench::write_json(json, {{"runs", rows}, {"gain_of_two_threads", threads}});
  }
  if (!good) std::printf("this is more memory, or less accuracy, than the method should have\n");
  return good ? 0 : 1;
}
