// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Patterns on surfaces, scene by scene: spots and stripes on spheres, a torus and an amorphous body, a body that grows
// where there is much of a species, and a dumbbell with spots that shrinks under its mean curvature through its pinch.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include <cambium/io.hpp>
#include <cambium/levelset/measures.hpp>
#include <cambium/levelset/shapes/amorphous.hpp>
#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/levelset/shapes/combination.hpp>
#include <cambium/levelset/shapes/dumbbell.hpp>
#include <cambium/levelset/shapes/torus.hpp>
#include <cambium/levelset/surface.hpp>
#include <cambium/models.hpp>
#include <cambium/reaction.hpp>

#include "command_line.hpp"

using namespace cambium;
using nlohmann::json;

namespace {

constexpr Vec<3> centre{0.0123, -0.0087, 0.0051};
using Body = LevelSet<ClosestPoint, 3>;

struct Options {
  std::ptrdiff_t cells = 48;
  double end = 0.0;  ///< 0: the scene's own
  int pictures = 1;
  bool smoke = false;
  std::string folder;
};

Lattice<3> cube(double half_edge, std::ptrdiff_t cells) {
  return Lattice<3>::bounded_box({Vec<3>::constant(-half_edge), Vec<3>::constant(half_edge)}, cells);
}

/// Writes vertices, triangles and the first species at the vertices: that of the value whose point is nearest.
template <class P>
void write_picture(P& pattern, const std::string& name) {
  const Surface<3> surface = extract_surface(pattern.surface().band());
  const auto& band = pattern.band();
  const double h = band.spacing();
  std::map<std::array<std::ptrdiff_t, 3>, std::vector<std::size_t>> cell;
  const auto key = [&](const Vec<3>& x, int dx, int dy, int dz) {
    return std::array<std::ptrdiff_t, 3>{static_cast<std::ptrdiff_t>(std::floor(x[0] / h)) + dx,
                                         static_cast<std::ptrdiff_t>(std::floor(x[1] / h)) + dy,
                                         static_cast<std::ptrdiff_t>(std::floor(x[2] / h)) + dz};
  };
  for (std::size_t k = 0; k < band.size(); ++k) cell[key(band.point(k), 0, 0, 0)].push_back(k);
  const std::size_t count = surface.vertices.size();
  std::vector<double> value(count);
  std::array<std::vector<double>, 3> x, e;
  for (std::size_t v = 0; v < count; ++v) {
    double nearest = 1e300;
    for (int n = 0; n < 27; ++n) {
      const auto found = cell.find(key(surface.vertices[v], n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
      if (found == cell.end()) continue;
      for (const std::size_t k : found->second) {
        const double distance = norm(band.point(k) - surface.vertices[v]);
        if (distance < nearest) {
          nearest = distance;
          value[v] = pattern.concentration(0)[k];
        }
      }
    }
    for (int d = 0; d < 3; ++d) x[static_cast<std::size_t>(d)].push_back(surface.vertices[v][d]);
  }
  for (const auto& element : surface.elements) {
    for (std::size_t d = 0; d < 3; ++d) e[d].push_back(static_cast<double>(element[d]));
  }
  write_npy(name + "_vertices.npy", Columns<3, const double>({x[0].data(), x[1].data(), x[2].data()}, count));
  write_npy(name + "_triangles.npy", Columns<3, const double>({e[0].data(), e[1].data(), e[2].data()}, e[0].size()));
  write_npy(name + "_c.npy", Columns<1, const double>({value.data()}, count));
}

/// Largest share of the area that one of the two sides of the middle of the range covers, range, and pieces inside.
template <class P>
json describe(P& pattern) {
  const auto c = pattern.concentration(0);
  const auto [low, high] = std::ranges::minmax(c);
  SurfaceIntegral<SurfaceLaplacian<2>> integral(pattern.surface(), pattern.band());
  const double middle = 0.5 * (low + high);
  const double area = integral(c, [](double) { return 1.0; });
  const double above = integral(c, [&](double x) { return x > middle ? 1.0 : 0.0; }) / area;
  const Measures<3> measure = measures(pattern.surface().band());
  return {{"t", pattern.time()},
          {"low", low},
          {"high", high},
          {"above", above},
          {"area", area},
          {"volume", measure.volume},
          {"parts", measure.inside_components},
          {"amount", integral(c)}};
}

/// Advances in `steps` parts, tells how it goes, and writes `pictures` pictures on the way, the last at the end.
template <class P>
json run(P& pattern, const std::string& name, double end, int steps, const Options& options) {
  json report{{"scene", name}, {"cells", options.cells}};
  std::size_t evaluations = 0;
  int picture = 0;
  const auto show = [&] {
    report["frames"].push_back(describe(pattern));
    report["frames"].back()["evaluations"] = evaluations;
    if (!options.folder.empty()) write_picture(pattern, options.folder + "/" + name + std::to_string(picture));
    ++picture;
  };
  if (options.pictures > 1) show();
  const int frames = std::max(1, options.pictures - 1);
  for (int n = 0; n < steps; ++n) {
    AdaptiveReport last;
    try {
      last = pattern.advance(end / steps);
    } catch (const InterfaceError& error) {
      std::printf("%s: t = %g: %s\n", name.c_str(), pattern.time(), error.what());
      report["ended"] = error.what();
      break;
    }
    evaluations += last.evaluations;
    if (n + 1 < steps && (n + 1) * frames / steps > n * frames / steps) show();
    if ((n + 1) * 10 / steps > n * 10 / steps) {
      const auto [low, high] = std::ranges::minmax(pattern.concentration(0));
      std::printf("%s: t = %9.4g, c1 in [%.4f, %.4f], %zu evaluations, step %.3g bound by %s\n", name.c_str(),
                  pattern.time(), low, high, evaluations, last.longest.dt, cambium::name(last.longest.bound));
      std::fflush(stdout);
    }
  }
  show();
  return report;
}

/// One type for the kinetics of all scenes and one for their motions: what scenes share is compiled once.
struct AnyKinetics {
  static constexpr int species = 2;
  KochMeinhardt koch_meinhardt;
  bool brusselator = false;

  Vec<2> operator()(const Vec<2>& c) const { return brusselator ? varea_spots(c) : koch_meinhardt(c); }
};
struct AnyMotion {
  static constexpr bool moves = true;
  static constexpr bool coupled = true;
  GrowthBySpecies<> growth;
  CurvatureMotion<> curvature;
  bool grows = true;

  template <class... Where>
  const BandVelocity<double, 3>& velocity(const Where&... where) {
    return grows ? growth.velocity(where...) : curvature.velocity(where...);
  }
};
template <class Motion = FixedSurface>
using Pattern = SurfacePattern<AnyKinetics, Motion>;

/// A uniform state with smooth noise.
template <class P>
void start(P& pattern, const Vec<2>& rest, double amplitude, double wave_number, std::uint64_t seed) {
  const SmoothNoise<3> first(seed, wave_number), second(seed + 1000, wave_number);
  pattern.sample([&](const Vec<3>& x) { return rest + amplitude * Vec<2>{first(x - centre), second(x - centre)}; });
}

json six_spots(const Options& o) {
  const double half = 2.02 * static_cast<double>(o.cells) / (static_cast<double>(o.cells) - 15.0);
  Pattern<> pattern(Body(cube(half, o.cells), Ball<3>(centre, 2.0)), AnyKinetics{koch_meinhardt_spots, true},
                    varea_diffusivities, {}, {.steps = {.absolute = 1e-6, .relative = 1e-3}});
  start(pattern, {}, 1e-3, 6.0, 3);
  return run(pattern, "six_spots", o.end > 0.0 ? o.end : 1500.0, 10, o);
}

template <class Shape>
json koch_meinhardt(const std::string& name, const Shape& shape, double half, const KochMeinhardt& kinetics,
                    const Options& o) {
  Pattern<> pattern(Body(cube(half, o.cells), shape), AnyKinetics{kinetics}, koch_meinhardt_unit_diffusivities, {},
                    {.steps = {.absolute = 1e-4, .relative = 1e-4}});
  start(pattern, kinetics.fixed_points()[0], 1e-2, 40.0, 1);
  return run(pattern, name, o.end > 0.0 ? o.end : 20000.0, 10, o);
}

/// u = n c1: where there is an activator the body bulges out; reaction of Koch and Meinhardt.
json growth(const Options& o) {
  Pattern<AnyMotion> pattern(Body(cube(0.55, o.cells), Ball<3>(centre, 0.2)), AnyKinetics{koch_meinhardt_spots},
                             koch_meinhardt_unit_diffusivities,
                             AnyMotion{GrowthBySpecies<>(4e-5), CurvatureMotion<>(), true},
                             {.steps = {.absolute = 1e-4, .relative = 1e-4}});
  start(pattern, koch_meinhardt_spots.fixed_points()[0], 5e-2, 40.0, 2);
  const double end = o.end > 0.0 ? o.end : 2000.0;
  return run(pattern, "growth", end, o.smoke ? 2 : 40, o);
}

json dumbbell(const Options& o) {
  const double h = 1.5 / static_cast<double>(o.cells);
  const Dumbbell<3> shape(centre - Vec<3>{0.3, 0.0, 0.0}, centre + Vec<3>{0.3, 0.0, 0.0}, 0.2, 0.09);
  // Chemistry as fast as the shape: rates and diffusivities are those of spots times 1e5. The spots are there before
  // the body moves.
  constexpr double fast = 1e5;
  KochMeinhardt kinetics = koch_meinhardt_spots;
  for (double* rate : {&kinetics.rho1, &kinetics.rho2, &kinetics.mu1, &kinetics.sigma2}) *rate *= fast;
  Pattern<AnyMotion> pattern(
      Body(cube(0.75, o.cells), shape), AnyKinetics{kinetics}, fast * koch_meinhardt_unit_diffusivities,
      AnyMotion{GrowthBySpecies<>(), CurvatureMotion<>(), false}, {.steps = {.absolute = 1e-3, .relative = 1e-3}});
  Pattern<> still(pattern.surface(), AnyKinetics{kinetics}, fast * koch_meinhardt_unit_diffusivities, {},
                  {.steps = {.absolute = 1e-3, .relative = 1e-3}});
  start(still, kinetics.fixed_points()[0], 0.1, 40.0, 1);
  still.advance(3000.0 / fast);
  for (int s = 0; s < 2; ++s) std::ranges::copy(still.concentration(s), pattern.state().column(s).begin());
  const double end = o.end > 0.0 ? o.end : 0.008;
  return run(pattern, "dumbbell", end, static_cast<int>(std::ceil(end / (0.15 * h * h))), o);
}

}  // namespace

int main(int argc, char** argv) try {
  const std::map<std::string, std::function<json(const Options&)>> scenes{
      {"six_spots", six_spots},
      {"sphere_spots",
       [](const Options& o) {
         return koch_meinhardt("sphere_spots", Ball<3>(centre, 0.3), 0.5, koch_meinhardt_spots, o);
       }},
      {"sphere_stripes",
       [](const Options& o) {
         return koch_meinhardt("sphere_stripes", Ball<3>(centre, 0.3), 0.5, koch_meinhardt_stripes, o);
       }},
      {"torus_spots",
       [](const Options& o) {
         return koch_meinhardt("torus_spots", Torus(centre, 0.25, 0.12, {0.2, 0.3, 1.0}), 0.55, koch_meinhardt_spots,
                               o);
       }},
      {"torus_stripes",
       [](const Options& o) {
         return koch_meinhardt("torus_stripes", Torus(centre, 0.25, 0.12, {0.2, 0.3, 1.0}), 0.55,
                               koch_meinhardt_stripes, o);
       }},
      {"amorphous_spots",
       [](const Options& o) {
         return koch_meinhardt("amorphous_spots", Amorphous<3>(centre, 0.2, 0.38, 5), 0.55, koch_meinhardt_spots, o);
       }},
      {"amorphous_stripes",
       [](const Options& o) {
         return koch_meinhardt("amorphous_stripes", Amorphous<3>(centre, 0.2, 0.38, 5), 0.55, koch_meinhardt_stripes,
                               o);
       }},
      {"growth", growth},
      {"dumbbell", dumbbell}};
  CLI::App app("Patterns on surfaces");
  Options options;
  std::vector<std::string> names;
  std::string file;
  app.add_option("scenes", names,
                 "which: six_spots, sphere_spots, sphere_stripes, torus_spots, torus_stripes, "
                 "amorphous_spots, amorphous_stripes, growth, dumbbell; none: a little of one");
  app.add_option("--cells", options.cells, "cells along an edge");
  app.add_option("--end", options.end, "time to run to; 0: the scene's own");
  app.add_option("--pictures", options.pictures, "pictures on the way, the last at the end");
  app.add_option("--fields", options.folder, "write surfaces to this folder, for scripts/draw_surface_pattern.py");
  app.add_option("--json", file, "write the figures to this file")->check(command_line::writable_file());
  CLI11_PARSE(app, argc, argv);
  if (!options.folder.empty()) std::filesystem::create_directories(options.folder);
  json runs = json::array();
  bool good = true;
  if (names.empty()) {
    options.smoke = true;
    options.cells = 36;
    options.end = 100.0;
    names = {"sphere_spots", "growth"};
  }
  for (const std::string& name : names) {
    const auto scene = scenes.find(name);
    if (scene == scenes.end()) {
      std::printf("there is no scene %s: see --help\n", name.c_str());
      return 1;
    }
    runs.push_back(scene->second(options));
    const json& last = runs.back()["frames"].back();
    good = good && std::isfinite(last["high"].get<double>()) && last["high"] > last["low"] && last["area"] > 0.0;
  }
  if (!file.empty()) command_line::write_text(file, json{{"runs", runs}}.dump(1));
  if (!good) std::printf("a scene is worse than it should be\n");
  return good ? 0 : 1;
} catch (const std::exception& error) {
  return command_line::failed(error);
}
