// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two scenes of the plane that bring an interface back to where it was: a disk with a slot (Zalesak 1979) that turns
// once and ten times, and a disk that LeVeque's vortex (1996) winds up into a filament and, from half time on, unwinds
// again. Backward advection takes long steps; the fewer, the less corners and filaments suffer.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <cambium/io.hpp>
#include <cambium/levelset.hpp>

#include "command_line.hpp"

using namespace cambium;

namespace {

constexpr double pi = std::numbers::pi;

using Flow = std::function<Vec<2>(const Vec<2>&, double)>;

struct Scene {
  std::string name;
  std::function<double(const Vec<2>&)> shape;
  Flow velocity;
  double period;  ///< after which the interface is back
  int repeats;    ///< periods to run
  bool returns;   ///< it goes back the way it came, so that half time is worth a look
};

Scene slotted_disk(int turns) {
  const auto turning = [](const Vec<2>& x, double) { return 2.0 * pi * Vec<2>{0.5 - x[1], x[0] - 0.5}; };
  return {"disk", ZalesakDisk({0.5, 0.75}, 0.15, 0.05, 0.25), turning, 1.0, turns, false};
}
Scene vortex() {
  constexpr double period = 8.0;
  const auto swirling = [](const Vec<2>& x, double t) {
    const double sx = std::sin(pi * x[0]), sy = std::sin(pi * x[1]), turn = std::cos(pi * t / period);
    return Vec<2>{-sx * sx * std::sin(2.0 * pi * x[1]) * turn, sy * sy * std::sin(2.0 * pi * x[0]) * turn};
  };
  return {"vortex", Ball<2>({0.5, 0.75}, 0.15), swirling, period, 1, true};
}

struct Result {
  int periods = 0;
  double area_half = 0.0;  ///< relative error at half time, if the flow returns
  double area = 0.0;       ///< relative error in the end
  double distance = 0.0;   ///< symmetric difference over perimeter, in spacings
  double seconds = 0.0;
};

/// The interface as segments: their ends, one row (x0, y0, x1, y1) each.
void write_curve(const NarrowBand<double, 2>& band, const std::string& name) {
  const Surface<2> curve = extract_surface(band);
  std::array<std::vector<double>, 4> column;
  for (const auto& element : curve.elements) {
    for (std::size_t k = 0; k < 4; ++k) column[k].push_back(curve.vertices[element[k / 2]][static_cast<int>(k % 2)]);
  }
  write_npy(name, Columns<4, const double>({column[0].data(), column[1].data(), column[2].data(), column[3].data()},
                                           column[0].size()));
}

/// Advances the scene in `steps` steps a period; results after the first and the last period.
template <class Reinit, class Advection>
std::vector<Result> run(const Scene& scene, std::ptrdiff_t cells, int steps, Advection advection,
                        const typename Reinit::Params& params, const std::string& file) {
  typename LevelSet<Reinit, 2>::Params level_set_params;
  level_set_params.reinit = params;
  LevelSet<Reinit, 2> level_set(Lattice<2>::bounded_box(Box<2>::cube(), cells), scene.shape, level_set_params);
  const Measures<2> start = measures(level_set.band());
  const double dt = scene.period / steps;
  const auto begin = std::chrono::steady_clock::now();
  std::vector<Result> results;
  Result result;
  for (int n = 1; n <= scene.repeats * steps; ++n) {
    try {
      advection.step(level_set, scene.velocity, (n - 1) * dt, dt);
    } catch (const InterfaceError& error) {  // results so far
      std::printf("at t = %g: %s\n", n * dt, error.what());
      return results;
    }
    if (scene.returns && 2 * n == steps) {
      result.area_half = measures(level_set.band()).volume / start.volume - 1.0;
      if (!file.empty()) write_curve(level_set.band(), file + "_half.npy");
    }
    if (n != steps && n != scene.repeats * steps) continue;
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    result.periods = n / steps;
    result.area = measures(level_set.band()).volume / start.volume - 1.0;
    result.distance = symmetric_difference(level_set.band(), scene.shape) / start.area / level_set.spacing();
    results.push_back(result);
    if (!file.empty()) write_curve(level_set.band(), file + "_" + std::to_string(result.periods) + ".npy");
  }
  return results;
}

struct Options {
  int turns = 10;
  int steps_of_disk = 5;
  int steps_of_vortex = 12;
  int substeps = 0;
};

/// A way to advance a level set, with its reinitialisation.
struct Policy {
  std::string name;
  std::function<std::vector<Result>(const Scene&, std::ptrdiff_t cells, const std::string& file)> run;
};

/// The default.
Policy backward(const Options& options) {
  return {"backward", [options](const Scene& scene, std::ptrdiff_t cells, const std::string& file) {
            const int steps = scene.returns ? options.steps_of_vortex : options.steps_of_disk;
            return run<ClosestPoint>(scene, cells, steps, Backward<>({.substeps = options.substeps}), {}, file);
          }};
}

std::vector<Policy> comparators() {
  using Strings = const std::string&;
  const auto eulerian = [](std::string name, const PdeReinitParams& params) {
    return Policy{std::move(name), [params](const Scene& scene, std::ptrdiff_t cells, Strings file) {
                    const int steps = scene.returns ? 64 : 16;
                    // What is best for each scene: the disk's corners suffer from every call, the filament from none.
                    const Eulerian<> advection({.reinitialise_every = scene.returns ? 1 : 10});
                    return run<PdeReinit<>>(scene, cells, steps, advection, params, file);
                  }};
  };
  return {{"lagrangian",
           [](const Scene& scene, std::ptrdiff_t cells, Strings file) {
             return run<ClosestPoint>(scene, cells, scene.returns ? 64 : 16, Lagrangian<>(), {}, file);
           }},
          {"particle corrected",
           [](const Scene& scene, std::ptrdiff_t cells, Strings file) {
             return run<ClosestPoint>(scene, cells, scene.returns ? 64 : 16, ParticleCorrected<>(), {}, file);
           }},
          eulerian("eulerian, WENO5", {.iterations = 5}),
          eulerian("eulerian, WENO5, subcell fix", {.iterations = 5, .subcell_fix = SubcellFix::russo_smereka})};
}

/// What backward advection is held to: measured, with some room.
bool is_good(const Scene& scene, std::ptrdiff_t cells, const Result& result) {
  const double area = std::abs(result.area);
  if (!scene.returns) {
    const double coarser = std::max(1.0, 100.0 / static_cast<double>(cells));
    return result.periods == 1 ? area < 0.0025 * coarser && result.distance < 0.05 * coarser
                               : area < 0.003 * coarser && result.distance < 0.2 * coarser;
  }
  // The filament is 2 spacings thin at 128 cells.
  if (cells >= 256) return area < 0.002 && result.distance < 0.3;
  return cells < 128 || (area < 0.02 && result.distance < 0.5);
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  std::vector<std::ptrdiff_t> cells_of_disk{100};
  std::vector<std::ptrdiff_t> cells_of_vortex{128, 256};
  bool compare = false;
  std::string json, folder;
  CLI::App app("A slotted disk that turns and a disk wound up by a vortex and unwound again");
  app.add_option("--cells-disk", cells_of_disk, "cells along an axis for the slotted disk, one run for each");
  app.add_option("--cells", cells_of_vortex, "cells along an axis for the vortex, one run for each");
  app.add_option("--turns", options.turns, "turns of the slotted disk")->check(CLI::PositiveNumber);
  app.add_option("--steps-disk", options.steps_of_disk, "steps a turn")->check(CLI::PositiveNumber);
  app.add_option("--steps", options.steps_of_vortex, "steps of the vortex, an even number")->check(CLI::PositiveNumber);
  app.add_option("--substeps", options.substeps, "Runge-Kutta steps in each step, 0 for as many as the paths ask")
      ->check(CLI::NonNegativeNumber);
  app.add_flag("--comparators", compare, "also by the other ways to advance a level set");
  app.add_option("--json", json, "write the figures to this file")->check(command_line::writable_file());
  app.add_option("--fields", folder,
                 "write the curves of the first run of each scene to this folder, for "
                 "scripts/draw_zalesak.py");
  CLI11_PARSE(app, argc, argv);

  std::vector<Policy> policies{backward(options)};
  if (compare) std::ranges::move(comparators(), std::back_inserter(policies));
  if (!folder.empty()) std::filesystem::create_directories(folder);
  nlohmann::json runs = nlohmann::json::array();
  bool good = true;
  std::printf("%-8s %6s %-30s %8s %14s %10s %10s %8s\n", "", "cells", "", "periods", "area at T/2", "area", "L1, h",
              "seconds");
  for (const Scene& scene : {slotted_disk(options.turns), vortex()}) {
    const std::vector<std::ptrdiff_t>& cells = scene.returns ? cells_of_vortex : cells_of_disk;
    for (const std::ptrdiff_t n : cells) {
      for (std::size_t p = 0; p < policies.size(); ++p) {
        const std::string file = folder + "/" + scene.name + "_" + std::to_string(p);
        const bool drawn = !folder.empty() && n == cells.front();
        const std::vector<Result> results = policies[p].run(scene, n, drawn ? file : "");
        if (p == 0) good &= !results.empty() && results.back().periods == scene.repeats;
        for (const Result& r : results) {
          std::printf("%-8s %6td %-30s %8d %13.3f%% %9.3f%% %10.3f %8.2f\n", scene.name.c_str(), n,
                      policies[p].name.c_str(), r.periods, 100.0 * r.area_half, 100.0 * r.area, r.distance, r.seconds);
          std::fflush(stdout);
          runs.push_back({{"scene", scene.name},
                          {"policy", policies[p].name},
                          {"cells", n},
                          {"periods", r.periods},
                          {"area_half", r.area_half},
                          {"area", r.area},
                          {"distance", r.distance},
                          {"seconds", r.seconds}});
          if (p == 0) good &= is_good(scene, n, r);
        }
      }
    }
  }
  if (!json.empty()) command_line::write_text(json, nlohmann::json{{"runs", runs}}.dump(2));
  if (!good) std::printf("this is worse than the method should be\n");
  return good ? 0 : 1;
} catch (const std::exception& error) {
  return command_line::failed(error);
}
