// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a value on a unit sphere costs: in an evaluation of the surface Laplacian, as a share of what the machine could
// do (a triad of long arrays, a loop of multiply-adds, measured in the same minutes), and in the preparations that an
// interface which moves asks for.
//
//     surface_scaling --cells 48 64 96 128 192 --json docs/charts/surface_scaling.json
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/surface.hpp>

#include "support/clock.hpp"
#include "support/command.hpp"
#include "support/peak.hpp"

using namespace cambium;

namespace bench {
namespace {

/// Least processor time of a call of f, over calls that take `total` seconds together.
template <class F>
double least_seconds(double total, F&& f) {
  double least = 1e300, spent = 0.0;
  do {
    const double start = cpu_seconds();
    f();
    least = std::min(least, cpu_seconds() - start);
    spent += cpu_seconds() - start;
  } while (spent < total);
  return least;
}

struct Machine {
  double bytes = 0.0;  ///< per second, a := b + s c on arrays that no cache holds
  double flops = 0.0;  ///< per second, a multiply-add being two
};

Machine measure_machine(double seconds, std::size_t length) {
  AlignedVector<double> a(length), b(length, 1.0), c(length, 2.0);
  const double triad = least_seconds(seconds, [&] {
    for (std::size_t i = 0; i < length; ++i) a[i] = b[i] + 0.5 * c[i];
    asm volatile("" : : "r"(a.data()) : "memory");
  });
  constexpr std::size_t steps = 200000;
  volatile double keep = 0.0;
  const double peak = least_seconds(seconds, [&] { keep = FmaPeak<double>::run(steps); });
  // A line that is written is read first.
  return {4.0 * 8.0 * static_cast<double>(length) / triad, FmaPeak<double>::flops_per_step * steps / peak};
}

/// What an evaluation cannot do without, for each value.
struct Work {
  double bytes = 0.0, flops = 0.0;
};

template <int Order>
Work least_work(const SurfaceBand<SurfaceLaplacian<Order>>& band) {
  constexpr double taps = SurfaceLaplacian<Order>::Kernel::support;
  double inner = 0.0;
  for (const auto& group : band.plan().groups) inner += static_cast<double>(product(group.inner));
  const auto values = static_cast<double>(band.size());
  const double entries = static_cast<double>(band.plan().entry.size()) / values;
  Work work;
  // Table of the patches, closest point, value read and rate written (and read before).
  work.bytes = 6.0 * entries + 24.0 + 8.0 + 16.0;
  // Tensor product of the taps, the taps by Horner's rule, the stencil.
  work.flops = 2.0 * (taps * taps * taps + taps * taps + taps) + 3.0 * taps * 2.0 * (taps - 1.0) +
               inner / values * (6.0 * Order / 2.0 + 2.0);
  return work;
}

template <int Order>
nlohmann::json measure(std::ptrdiff_t cells, const Machine& machine, double seconds) {
  const Lattice<3> lattice = Lattice<3>::bounded_box({Vec<3>::constant(-1.6), Vec<3>::constant(1.6)}, cells);
  const LevelSet<> sphere(lattice, Ball<3>({0.013, 0.002, -0.009}, 1.0), {}, Serial{});
  SurfaceBand<SurfaceLaplacian<Order>> band;
  const double fit = least_seconds(0.0, [&] { band.fit(sphere, Serial{}); });
  const auto values = static_cast<double>(band.size());
  AlignedVector<double> c(band.size()), rate(band.size()), c2(band.size(), 1.0), rate2(band.size());
  band.sample([](const Vec<3>& x) { return x[2] + x[0] * x[1]; }, c);
  const double one = least_seconds(seconds, [&] { band.laplacian(c, rate, Serial{}); });
  const Columns<2, const double> from({c.data(), c2.data()}, band.size());
  const Columns<2, double> to({rate.data(), rate2.data()}, band.size());
  const double two = least_seconds(seconds, [&] { band.laplacian(from, to, Serial{}); });
  const Work work = least_work(band);
  const double of_bytes = work.bytes * values / machine.bytes, of_flops = work.flops * values / machine.flops;
  const double share = std::max(of_bytes, of_flops) / one;
  std::printf("%5td %5d %8zu %10.1f %10.1f %8.0f %8.1f %8.1f %7.0f%% (%s)\n", cells, Order, band.size(),
              one / values * 1e9, two / values * 0.5e9, fit / values * 1e9, of_bytes / values * 1e9,
              of_flops / values * 1e9, 100.0 * share, of_bytes > of_flops ? "memory" : "arithmetic");
  std::fflush(stdout);
  return {{"cells", cells},
          {"order", Order},
          {"values", band.size()},
          {"rate_ns", one / values * 1e9},
          {"rate_of_two_species_ns", two / values * 0.5e9},
          {"fit_ns", fit / values * 1e9},
          {"bytes", work.bytes},
          {"flops", work.flops},
          {"share_of_bound", share},
          {"bound", of_bytes > of_flops ? "memory" : "arithmetic"}};
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  using namespace bench;
  std::vector<std::ptrdiff_t> cells{48, 64, 96, 128, 192};
  double seconds = 0.5;
  std::string json;
  bool quick = false;
  CLI::App app("Time of the surface Laplacian for each value on a sphere");
  app.add_option("--cells", cells, "cells along an axis, one run for each");
  app.add_option("--seconds", seconds, "processor time of each measurement")->check(CLI::PositiveNumber);
  app.add_option("--json", json, "write the figures to this file");
  app.add_flag("--quick", quick, "two small lattices: a test that the program runs");
  CLI11_PARSE(app, argc, argv);
  if (quick) {
    cells = {24, 32};
    seconds = 0.01;
  }
  const Machine machine = measure_machine(seconds, quick ? 100000 : 8000000);
  std::printf("one thread: %.1f GB/s, %.1f Gflop/s\n", machine.bytes * 1e-9, machine.flops * 1e-9);
  std::printf("%5s %5s %8s %10s %10s %8s %8s %8s %7s\n", "cells", "order", "values", "rate ns", "of two ns", "fit ns",
              "bytes ns", "flops ns", "share");
  nlohmann::json runs = nlohmann::json::array();
  for (const auto n : cells) {
    runs.push_back(measure<2>(n, machine, seconds));
#if !BENCH_SMOKE
    runs.push_back(measure<4>(n, machine, seconds));
#endif
  }
  if (!json.empty()) {
    const nlohmann::json of_machine{{"bytes_per_second", machine.bytes}, {"flops_per_second", machine.flops}};
    bench::write_json(json, {{"machine", of_machine}, {"runs", runs}});
  }
  return 0;
}
