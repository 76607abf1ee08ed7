// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What reinitialisation does to an interface that should not move: balls of 10.7 spacings and a slab two spacings
// thick, reinitialised a thousand times. Closest points leave a distance as it is to the last bit; upwind stencils that
// cross the interface make a ball vanish.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include <cambium/io.hpp>
#include <cambium/levelset.hpp>

#include "command_line.hpp"

using namespace cambium;

namespace {

constexpr double spacing = 0.1875;
constexpr double radius = 2.0;

struct Scene {
  std::string name;
  Lattice<3> lattice;
  std::function<double(const Vec<3>&)> distance;
  std::function<double(const Vec<3>&)> start;  ///< phi at the start, of the same zero set
};

std::vector<Scene> scenes() {
  const Lattice<3> box(Box<3>{Vec<3>::constant(-4.5), Vec<3>::constant(4.5)}, spacing, {false, false, false});
  const Lattice<3> column(Box<3>{{-0.75, -0.75, -2.25}, {0.75, 0.75, 2.25}}, spacing, {true, true, false});
  const Ball<3> centred({0.0, 0.0, 0.0}, radius);
  const Ball<3> shifted({0.06, 0.03, -0.08}, radius);
  const auto slab = [](const Vec<3>& x) { return std::abs(x[2] - 0.08) - spacing; };
  // Slopes between 1 and 10.
  const auto steep = [shifted](const Vec<3>& x) {
    return shifted(x) * (5.5 + 4.5 * std::sin(0.8 * x[0]) * std::sin(0.8 * x[1] + 0.4) * std::sin(0.8 * x[2] + 0.8));
  };
  return {{"ball", box, centred, centred},
          {"ball off-centre", box, shifted, shifted},
          {"ball, steep start", box, shifted, steep},
          {"slab", column, slab, slab}};
}

/// The state after so many calls.
struct State {
  int calls = 0;
  double volume = 0.0;        ///< relative to that at the start
  double displacement = 0.0;  ///< largest distance of the interface from where it was, in spacings
};

struct Result {
  std::vector<State> history;
  int rests_from = 0;  ///< calls after which a call changed no bit, so that none will; 0 if each did
  int vanished = 0;    ///< calls up to the one that found no interface; 0 if it is still there
  double seconds = 0.0;
};

struct Options {
  int calls = 1300;
  bool all = false;
  std::string folder;
};

/// Largest |distance| over points of the interface where it crosses the edges of the lattice: for a slab by the linear
/// interpolant, which is exact next to a plane, however thin the slab.
double farthest(const NarrowBand<double, 3>& band, const Scene& scene) {
  const Surface<3> surface = extract_surface(band, {.projected = scene.name != "slab"});
  double most = 0.0;
  for (const Vec<3>& x : surface.vertices) most = std::max(most, std::abs(scene.distance(x)));
  return most / band.spacing();
}

bool same_bits(const NarrowBand<double, 3>& a, const NarrowBand<double, 3>& b) {
  if (a.blocks() != b.blocks()) return false;
  for (std::size_t k = 0; k < a.blocks(); ++k) {
    const auto p = a.values().block(k), q = b.values().block(k);
    if (std::memcmp(p.data(), q.data(), p.size_bytes()) != 0) return false;
  }
  return true;
}

/// phi in the plane y = 0, for the picture.
void write_section(const NarrowBand<double, 3>& band, const std::string& name) {
  const Index<3> nodes = band.lattice().nodes();
  const auto plane = Lattice<2>(Box<2>{{-4.5, -4.5}, {4.5, 4.5}}, spacing, {false, false});
  Field<double, 2> section(plane);
  for (std::size_t i = 0; i < section.size(); ++i) {
    const Index<2> at = plane.node(i);
    section[i] = band({at[0], nodes[1] / 2, at[1]});
  }
  write_npy(name, section);
}

double enclosed(const NarrowBand<double, 3>& band) { return measures(band).volume; }

template <class R>
Result run(const Scene& scene, const typename R::Params& params, const Options& options, const std::string& file) {
  typename LevelSet<R>::Params level_set_params;
  level_set_params.reinit = params;
  const LevelSet<> reference(scene.lattice, scene.distance);
  const double volume = enclosed(reference.band()), at_start = farthest(reference.band(), scene);
  const auto begin = std::chrono::steady_clock::now();
  Result result;
  LevelSet<R> level_set(scene.lattice, scene.start, level_set_params);  // that was the first call
  const auto note = [&](int calls) {
    result.history.push_back(
        {calls, enclosed(level_set.band()) / volume - 1.0, farthest(level_set.band(), scene) - at_start});
    if (!file.empty()) write_section(level_set.band(), file + "_" + std::to_string(calls) + ".npy");
  };
  int calls = 1;
  try {
    note(1);
    for (double next = 1.3; calls < options.calls;) {
      const NarrowBand<double, 3> before = level_set.band();
      level_set.reinitialise();
      ++calls;
      const bool rests = same_bits(before, level_set.band());
      if (calls >= next || rests || calls == options.calls) note(calls);
      while (next <= calls) next *= 1.3;
      if (!rests) continue;
      if (result.rests_from == 0) result.rests_from = calls - 1;
      if (!options.all) break;  // the next call would start from the same bits
    }
  } catch (const InterfaceError&) {
    result.vanished = calls + 1;
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

struct Policy {
  std::string name;
  std::function<Result(const Scene&, const Options&, const std::string&)> run;
};

template <class R>
Policy policy(std::string name, const typename R::Params& params = {}) {
  return {std::move(name), [params](const Scene& scene, const Options& options, const std::string& file) {
            return run<R>(scene, params, options, file);
          }};
}

std::vector<Policy> comparators() {
  using enum SubcellFix;
  return {policy<FastMarching<ChoppKickOff, 1>>("fast marching, order 1"),
          policy<FastMarching<>>("fast marching, order 2"),
          policy<FastSweeping<>>("fast sweeping"),
          policy<GroupMarching<>>("group marching"),
          policy<GradientNormalised>("phi / |grad phi|"),
          policy<LagrangianReinit<>>("Lagrangian"),
          policy<PdeReinit<WENO5>>("PDE, WENO5, 5", {.iterations = 5}),
          policy<PdeReinit<WENO5>>("PDE, WENO5, 20", {.iterations = 20}),
          policy<PdeReinit<WENO5>>("PDE, WENO5, 5, Russo-Smereka", {.iterations = 5, .subcell_fix = russo_smereka}),
          policy<PdeReinit<WENO5>>("PDE, WENO5, 5, subcell fix", {.iterations = 5, .subcell_fix = high_order}),
          policy<PdeReinit<WENO3>>("PDE, WENO3, 36", {.iterations = 36}),
          policy<PdeReinit<WENO3>>("PDE, WENO3, 60", {.iterations = 60})};
}

/// What closest points are held to: 1e-4 of the volume and 0.01 spacings, five times that beyond 1,300 calls.
bool is_good(const Result& result, int calls) {
  const double factor = calls > 1300 ? 5.0 : 1.0;
  return result.vanished == 0 && std::ranges::all_of(result.history, [&](const State& state) {
           return std::abs(state.volume) < 1e-4 * factor && state.displacement < 0.01 * factor;
         });
}

void print(const std::string& policy, const std::string& scene, const Result& result) {
  std::printf("%-30s %-18s ", policy.c_str(), scene.c_str());
  const State& last = result.history.back();
  if (result.vanished > 0) {
    std::printf("%38s %6d", "vanished at call", result.vanished);
  } else {
    std::printf("%14.2e %16.2e h %6d calls", last.volume, last.displacement, last.calls);
  }
  if (result.rests_from > 0) std::printf(", rests from call %d", result.rests_from);
  std::printf("  %.1f s\n", result.seconds);
  std::fflush(stdout);
}

nlohmann::json as_json(const std::string& policy, const std::string& scene, const Result& result) {
  nlohmann::json history = nlohmann::json::array();
  for (const State& state : result.history) {
    history.push_back({{"calls", state.calls}, {"volume", state.volume}, {"displacement", state.displacement}});
  }
  return {{"policy", policy},
          {"scene", scene},
          {"history", history},
          {"rests_from", result.rests_from},
          {"vanished", result.vanished},
          {"seconds", result.seconds}};
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  bool compare = false;
  std::string json;
  std::vector<std::string> chosen;
  for (const Scene& scene : scenes()) chosen.push_back(scene.name);
  CLI::App app("What a thousand reinitialisations do to interfaces that should not move");
  app.add_option("--calls", options.calls, "reinitialisations")->check(CLI::PositiveNumber);
  app.add_option("--scenes", chosen, "which of the scenes")->check(CLI::IsMember(chosen));
  app.add_flag("--comparators", compare, "also by the other reinitialisations");
  app.add_flag("--all-calls", options.all, "go on calling where phi rests");
  app.add_option("--json", json, "write the figures to this file")->check(command_line::writable_file());
  app.add_option("--fields", options.folder,
                 "write sections of the ball to this folder, for scripts/draw_reinit_drift.py");
  CLI11_PARSE(app, argc, argv);

  std::vector<Policy> policies{policy<ClosestPoint>("closest points")};
  if (compare) std::ranges::move(comparators(), std::back_inserter(policies));
  if (!options.folder.empty()) std::filesystem::create_directories(options.folder);
  std::printf("%-30s %-18s %14s %18s\n", "", "", "volume", "displacement");
  nlohmann::json runs = nlohmann::json::array();
  bool good = true;
  for (std::size_t p = 0; p < policies.size(); ++p) {
    for (const Scene& scene : scenes()) {
      if (std::ranges::find(chosen, scene.name) == chosen.end()) continue;
      const bool drawn = scene.name == "ball off-centre" && !options.folder.empty();
      const std::string file = options.folder + "/section_" + std::to_string(p);
      Result result;
      try {
        result = policies[p].run(scene, options, drawn ? file : "");
      } catch (const Error& error) {  // a first call that leaves nothing to go on with
        std::printf("%-30s %-18s %s\n", policies[p].name.c_str(), scene.name.c_str(), error.what());
        good &= p > 0;
        continue;
      }
      print(policies[p].name, scene.name, result);
      runs.push_back(as_json(policies[p].name, scene.name, result));
      if (p == 0) good &= is_good(result, options.calls);
    }
  }
  if (!json.empty()) command_line::write_text(json, nlohmann::json{{"runs", runs}}.dump(2));
  if (!good) std::printf("closest points move the interface more than they should\n");
  return good ? 0 : 1;
} catch (const std::exception& error) {
  return command_line::failed(error);
}
