// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Tumours against what is known of them. Each verification is an option; see tumour/verification.hpp.
#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "support/command.hpp"
#include "tumour/verification.hpp"

namespace {

using Verification = nlohmann::json (*)(const bench::TumourOptions&);
struct Named {
  const char* name;
  const char* description;
  Verification verification;
};

std::vector<Named> verifications() {
  return {
    {"--reference", "integral equations along the interface against exact solutions", bench::verify_reference},
        {"--ellipse", "the ellipse of (11.72) in the plane against them", bench::verify_ellipse},
#if !BENCH_SMOKE
        {"--rates", "rates of growth of small waves", bench::verify_rates},
        {"--speed", "mean speed of balls", bench::verify_speed},
        {"--radius", "R(1) of discs and balls", bench::verify_radius},
        {"--relaxation", "surface tension alone, in space", bench::verify_relaxation},
        {"--box-size", "one tumour in boxes of 24 and 48", bench::verify_box},
        {"--convergence", "one tumour in space on finer and finer lattices", bench::verify_convergence},
        {"--compositions", "error of a radius and a rate against seconds", bench::compare_compositions},
        {"--cost", "time of a step in space and memory", bench::measure_cost},
#endif
  };
}

}  // namespace

int main(int argc, char** argv) {
  bench::TumourOptions options;
  std::string json;
  CLI::App app("Tumours against what is known of them");
  auto known = verifications();
  std::vector<int> wanted(known.size());
  for (std::size_t k = 0; k < known.size(); ++k) app.add_flag(known[k].name, wanted[k], known[k].description);
  app.add_option("--cells", options.cells, "cells along an axis");
  app.add_option("--dimension", options.dimension, "2 or 3 alone");
  app.add_option("--end", options.end, "time to run to");
  app.add_option("--tension", options.tension, "gamma");
  app.add_option("--threads", options.threads, "threads");
  app.add_flag("--smoke", options.smoke, "as little as shows that it works");
  app.add_option("--json", json, "write the figures to this file");
  CLI11_PARSE(app, argc, argv);
  nlohmann::json runs = nlohmann::json::array();
  for (std::size_t k = 0; k < known.size(); ++k) {
    if (wanted[k] == 0) continue;
    for (auto& run : known[k].verification(options)) runs.push_back(std::move(run));
  }
  if (!json.empty()) bench::write_json(json, {{"runs", runs}});
  return 0;
}
