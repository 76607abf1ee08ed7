// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A ball in the three-dimensional deformation of LeVeque (1996), as Enright et al. (2002) made it a test of level sets:
// the flow pulls the ball out into a sheet about a spacing thin and, from half time on, back again. Steps are long:
// each follows particles back through a quarter of a unit of time and interpolates once.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include <cambium/io.hpp>
#include <cambium/levelset.hpp>

#include "command_line.hpp"

using namespace cambium;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double period = 3.0;
const Ball<3> ball({0.35, 0.35, 0.35}, 0.15);

/// Turns back at t = T / 2.
Vec<3> velocity(const Vec<3>& x, double t) {
  Vec<3> s, s2;
  for (int d = 0; d < 3; ++d) {
    s[d] = std::sin(pi * x[d]);
    s2[d] = 2.0 * s[d] * std::cos(pi * x[d]);
  }
  const Vec<3> u{2.0 * s[0] * s[0] * s2[1] * s2[2], -s2[0] * s[1] * s[1] * s2[2], -s2[0] * s2[1] * s[2] * s[2]};
  return std::cos(pi * t / period) * u;
}

struct Options {
  int steps = 12;
  int substeps = 0;
};

struct Result {
  std::ptrdiff_t cells = 0;
  double volume_half = 0.0;  ///< relative error at T / 2
  double volume_end = 0.0;   ///< and at T
  double distance = 0.0;     ///< symmetric difference over area, in spacings, at T
  std::size_t parts = 0;     ///< of the inside at T: 1, and what came off where the sheet was below the lattice
  double seconds = 0.0;
  std::size_t interpolations = 0;
  std::size_t reinitialisations = 0;
};

void write_surface(const NarrowBand<double, 3>& band, const std::string& name) {
  const Surface<3> surface = extract_surface(band);
  const auto columns = [&](const auto& list, auto to_double) {
    std::array<std::vector<double>, 3> column;
    for (const auto& entry : list) {
      for (std::size_t d = 0; d < 3; ++d) column[d].push_back(to_double(entry, d));
    }
    return column;
  };
  const auto x = columns(surface.vertices, [](const Vec<3>& v, std::size_t d) { return v[static_cast<int>(d)]; });
  const auto e = columns(surface.elements, [](const auto& v, std::size_t d) { return static_cast<double>(v[d]); });
  const auto write = [&](const auto& column, const char* what) {
    write_npy(name + what,
              Columns<3, const double>({column[0].data(), column[1].data(), column[2].data()}, column[0].size()));
  };
  write(x, "_vertices.npy");
  write(e, "_triangles.npy");
}

Result run(std::ptrdiff_t cells, const Options& options, const std::string& folder) {
  LevelSet<ClosestPoint, 3> level_set(Lattice<3>::bounded_box(Box<3>::cube(), cells), ball);
  Backward<> advection({.substeps = options.substeps});
  const Measures<3> start = measures(level_set.band());
  const double dt = period / options.steps;

  Result result{.cells = cells};
  double half = 0.0;
  const auto begin = std::chrono::steady_clock::now();
  for (int n = 0; n < options.steps; ++n) {
    const AdvectionReport report = advection.step(level_set, velocity, n * dt, dt);
    result.interpolations += report.steps;
    result.reinitialisations += report.reinitialisations;
    if (2 * (n + 1) == options.steps) {
      half = measures(level_set.band()).volume;
      if (!folder.empty()) write_surface(level_set.band(), folder + "/half");
    }
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!folder.empty()) write_surface(level_set.band(), folder + "/end");
  result.volume_half = half / start.volume - 1.0;
  const Measures<3> end = measures(level_set.band());
  result.volume_end = end.volume / start.volume - 1.0;
  result.parts = end.inside_components;
  result.distance = symmetric_difference(level_set.band(), ball) / start.area / level_set.spacing();
  return result;
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::ptrdiff_t> cells{64};
  Options options;
  std::string json;
  std::string folder;
  CLI::App app("A ball pulled out into a thin sheet and back again");
  app.add_option("--cells", cells, "cells along an axis, one run for each");
  app.add_option("--steps", options.steps, "steps of the level set, an even number")->check(CLI::PositiveNumber);
  app.add_option("--substeps", options.substeps, "Runge-Kutta steps in each of them; 0 for as many as the paths ask")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--json", json, "write the figures to this file")->check(command_line::writable_file());
  app.add_option("--fields", folder, "write the surfaces of the last run to this folder, for scripts/draw_enright.py");
  CLI11_PARSE(app, argc, argv);

  nlohmann::json runs = nlohmann::json::array();
  bool good = true;
  std::printf("%5s %16s %16s %12s %6s %10s\n", "cells", "volume at T/2", "volume at T", "L1 at T, h", "parts",
              "seconds");
  for (const auto n : cells) {
    const std::string to = n == cells.back() ? folder : "";
    if (!to.empty()) std::filesystem::create_directories(to);
    const Result r = run(n, options, to);
    std::printf("%5td %15.3f%% %15.3f%% %12.3f %6zu %10.2f\n", n, 100.0 * r.volume_half, 100.0 * r.volume_end,
                r.distance, r.parts, r.seconds);
    runs.push_back({{"cells", n},
                    {"volume_half", r.volume_half},
                    {"volume_end", r.volume_end},
                    {"distance", r.distance},
                    {"parts", r.parts},
                    {"seconds", r.seconds},
                    {"interpolations", r.interpolations},
                    {"reinitialisations", r.reinitialisations}});
    // The sheet is a spacing thin at 64 cells; errors fall at least linearly from there.
    const double allowed = 64.0 / static_cast<double>(n);
    good &= std::abs(r.volume_half) < 0.06 * allowed && std::abs(r.volume_end) < 0.05 * allowed && r.distance < 0.3;
  }
  if (!json.empty()) command_line::write_text(json, nlohmann::json{{"runs", runs}}.dump(2));
  if (!good) std::printf("this is worse than the method should be\n");
  return good ? 0 : 1;
} catch (const std::exception& error) {
  return command_line::failed(error);
}
