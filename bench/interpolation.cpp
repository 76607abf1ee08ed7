// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Speed of P2M, M2P and remeshing beside plain loops, beside the multiply-adds a core can do at most, and beside what
// arithmetic gains from a second thread. What is compared takes turns (support/contest.hpp). Work on one thread is
// measured in processor time, work on two on the wall.
//
//     interpolation --benchmark_out=raw.json     then scripts/summarise_interpolation.py raw.json
#include <CLI/CLI.hpp>
#include <benchmark/benchmark.h>
#include <string>
#include <vector>

#include "interpolation/options.hpp"

int main(int argc, char** argv) {
  bench::Options options;
  CLI::App app("Speed of P2M, M2P and remeshing. Options of Google Benchmark (--benchmark_...) are taken, too.");
  app.allow_extras();
  app.add_option("--rounds", options.rounds, "how often M4' and M6, and remeshing, are measured")
      ->check(CLI::PositiveNumber);
  app.add_option("--rounds-of-others", options.rounds_of_others, "how often the other kernels are measured")
      ->check(CLI::PositiveNumber);
  app.add_option("--cells-2d", options.cells_2d, "cells along an axis in 2D");
  app.add_option("--cells-3d", options.cells_3d, "cells along an axis in 3D");
  app.add_option("--error-cells", options.error_cells,
                 "cells along an axis for the error of remeshing, coarse to fine");
  app.add_option("--peak-steps", options.peak_steps, "length of the loop that measures the multiply-adds");
  CLI11_PARSE(app, argc, argv);

  std::vector<std::string> rest = app.remaining();
  rest.insert(rest.begin(), argv[0]);
  std::vector<char*> arguments;
  for (std::string& argument : rest) arguments.push_back(argument.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 1;
  benchmark::AddCustomContext("cells_2d", std::to_string(options.cells_2d));
  benchmark::AddCustomContext("cells_3d", std::to_string(options.cells_3d));
  benchmark::AddCustomContext("compiler", __VERSION__);
  bench::enter_contests(options);
  return benchmark::RunSpecifiedBenchmarks() > 0 ? 0 : 1;
}
