// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where reinitialisations and advections of level sets fail: every method on scenes that are hard on it, 2D and 3D.
//
// A scene gives phi, not always a distance, on a coarse lattice, and the distance of the shape that it stands for. A
// reinitialisation makes phi a distance, once or as often as the scene says; an advection carries the shape once around
// the middle of the box, with ClosestPoint, so that it should be as it was. What is left is held against the shape:
//   drift     largest displacement of the interface, where lattice lines cross it, in h
//   volume    change of the volume, as the layer that it would be on the interface, in h
//   distance  largest |phi - distance| within 3 h of the interface, where the distance is smooth, in h
//   parts     of the inside; to be those that phi as given shows on the lattice
// Outcomes, by Limits: up to 0.1 h, where a scene is resolved by the lattice, and half a spacing where it is not, is
// kept
//   kept      drift, volume and distance are within what is resolved, and the number of parts is right
//   degraded  one of them is not, but phi is of use
//   error     the method, or the level set around it, threw a cambium::Error that says why
//   broken    without an error: a value that is not finite, no closed interface, a part of the inside or a hole in it
//             further than 2 h from the shape, or an interface or a distance off by more than 2 h
//
//     failure_map_levelset --json raw.json     then scripts/draw_failure_map_levelset.py raw.json
//
// Returns non-zero if ClosestPoint, or Backward with it, is broken or throws anywhere.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include <cambium/levelset.hpp>

#include "support/command.hpp"

using namespace cambium;

namespace bench {
namespace {

/// What a method may do to a scene, in spacings.
struct Limits {
  double drift = 0.1;     ///< of the interface, and of the volume, to count as kept
  double distance = 0.1;  ///< of phi
};
constexpr double broken = 2.0;  ///< either of them

/// A shape by its distance, and phi as a method gets it.
template <int D>
struct Scene {
  std::string name;
  std::ptrdiff_t cells;  ///< along a unit, an even number
  std::function<double(const Vec<D>&)> phi;
  std::function<double(const Vec<D>&)> distance;
  /// True where the distance is smooth as far as stencils reach.
  std::function<bool(const Vec<D>&)> smooth;
  int calls = 1;
  Limits limits = {};

  /// The unit box, in which shapes are, and room around it for what turns.
  Lattice<D> lattice() const {
    return Lattice<D>::bounded_box({Vec<D>::constant(-0.25), Vec<D>::constant(1.25)}, cells + cells / 2);
  }
  double spacing() const { return 1.0 / static_cast<double>(cells); }
};

template <int D>
Vec<D> middle() {
  return Vec<D>::constant(0.5) + Vec<D>::unit(0, 0.0031) + Vec<D>::unit(1, 0.0047);
}

/// A number in [-1, 1] that belongs to a node.
template <int D>
double noise(const Vec<D>& x, double h) {
  std::uint64_t bits = 1469598103934665603ULL;
  for (int d = 0; d < D; ++d) {
    bits = (bits ^ static_cast<std::uint64_t>(std::llround(x[d] / h) + 7)) * 1099511628211ULL;
    bits ^= bits >> 29;
  }
  bits *= 0xbf58476d1ce4e5b9ULL;
  bits ^= bits >> 32;
  return static_cast<double>(bits % 20001) / 1e4 - 1.0;
}

/// A wall of two sides `thickness` apart, bent to a ring (a shell in 3D).
template <int D>
Scene<D> filament(std::ptrdiff_t n) {
  const double h = 1.0 / static_cast<double>(n);
  const auto distance = [h](const Vec<D>& x) { return std::abs(norm(x - middle<D>()) - 0.3) - 0.45 * h; };
  // The distance has its kink in the middle of the wall: what is smooth is 3 h off it.
  const auto smooth = [h](const Vec<D>& x) { return std::abs(norm(x - middle<D>()) - 0.3) > 2.0 * h; };
  return {"filament", n, distance, distance, smooth, 1, {.drift = 0.5, .distance = 0.5}};
}

template <int D>
Scene<D> touching(std::ptrdiff_t n) {
  const double h = 1.0 / static_cast<double>(n), r = 0.18;
  const auto centre = [=](double side) {
    Vec<D> c = middle<D>() + Vec<D>::unit(0, side * (r + 0.25 * h) * std::cos(0.3));
    c[1] += side * (r + 0.25 * h) * std::sin(0.3);
    return c;
  };
  const auto distance = [=](const Vec<D>& x) { return std::min(norm(x - centre(1.0)), norm(x - centre(-1.0))) - r; };
  const auto smooth = [=](const Vec<D>& x) {
    const double ridge = std::abs(norm(x - centre(1.0)) - norm(x - centre(-1.0)));
    return ridge > 8.0 * h && distance(x) > -0.5 * r;
  };
  return {"touching fronts", n, distance, distance, smooth, 1, {.drift = 0.5}};
}

/// Lobes whose neck is one spacing thick, its sides drawn in smoothly.
template <int D>
Scene<D> pinch(std::ptrdiff_t n) {
  const double h = 1.0 / static_cast<double>(n), r = 0.17, neck = 0.5 * h;
  const Vec<D> a = middle<D>() - Vec<D>::unit(0, 0.22), b = middle<D>() + Vec<D>::unit(0, 0.22);
  const Dumbbell<D> dumbbell(a, b, r, neck);
  const auto smooth = [=](const Vec<D>& x) {
    const double along = std::abs(x[0] - middle<D>()[0]);
    return along > 0.22 && dumbbell(x) > -0.5 * r;
  };
  return {"pinching neck", n, dumbbell, dumbbell, smooth, 1, {.drift = 0.5}};
}

template <int D>
Scene<D> corner(std::ptrdiff_t n) {
  const double h = 1.0 / static_cast<double>(n);
  const Cuboid<D> cuboid({middle<D>() - Vec<D>::constant(0.23), middle<D>() + Vec<D>::constant(0.23)});
  const auto smooth = [=](const Vec<D>& x) {
    int near = 0;
    for (int d = 0; d < D; ++d) near += std::abs(x[d] - middle<D>()[d]) > 0.23 - 6.0 * h ? 1 : 0;
    return near == 1;
  };
  return {"corner", n, cuboid, cuboid, smooth, 1, {.drift = 0.5}};
}

/// An ellipse of slopes from 0.1 to 10: the factor changes tenfold over a quarter of the box.
template <int D>
Scene<D> scaled(std::ptrdiff_t n) {
  const auto distance = [](const Vec<D>& x) { return norm(x - middle<D>()) - 0.27; };
  const auto phi = [=](const Vec<D>& x) {
    return std::pow(10.0, std::sin(6.0 * x[0] + 0.5) * std::cos(5.0 * x[1])) * distance(x);
  };
  const auto smooth = [=](const Vec<D>& x) { return distance(x) > -0.2; };
  return {"slopes 0.1 to 10", n, phi, distance, smooth, 1, {}};
}

template <int D>
Scene<D> repeated(std::ptrdiff_t n, int calls) {
  const auto distance = [](const Vec<D>& x) { return norm(x - middle<D>()) - 0.27; };
  const auto smooth = [=](const Vec<D>& x) { return distance(x) > -0.2; };
  return {std::to_string(calls) + " calls", n, distance, distance, smooth, calls, {}};
}

template <int D>
Scene<D> noisy(std::ptrdiff_t n) {
  const double h = 1.0 / static_cast<double>(n);
  const auto distance = [](const Vec<D>& x) { return norm(x - middle<D>()) - 0.27; };
  const auto phi = [=](const Vec<D>& x) { return distance(x) + 0.1 * h * noise(x, h); };
  const auto smooth = [=](const Vec<D>& x) { return distance(x) > -0.2; };
  // The interface itself is off by the noise, and its normals more.
  return {"noise of 0.1 h", n, phi, distance, smooth, 1, {.drift = 0.3, .distance = 0.3}};
}

struct Result {
  std::string outcome = "error";
  std::string error = "";
  double drift = 0.0;
  double volume = 0.0;
  double distance = 0.0;
  std::size_t parts = 0;
};

/// A reinitialisation that leaves phi as it is given.
struct AsGiven {
  struct Params {};
  template <class T, int D>
  struct Method {
    explicit Method(const Params&) {}
    template <Execution E>
    ReinitReport operator()(NarrowBand<T, D>&, const E&) {
      return {};
    }
  };
};

/// Volume of the shape, by 4^D points in the cells around nodes next to its surface.
template <int D>
double volume_of(const Scene<D>& scene) {
  constexpr int finer = 4;
  const Lattice<D> lattice = scene.lattice();
  const double h = scene.spacing();
  const Index<D> part = Index<D>::constant(finer);
  double sum = 0.0;
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    const Vec<D> x = lattice.position(lattice.node(k));
    if (const double value = scene.distance(x); std::abs(value) > h) {
      sum += value < 0.0 ? 1.0 : 0.0;
      continue;
    }
    for (std::ptrdiff_t p = 0; p < product(part); ++p) {
      Vec<D> y = x;
      std::ptrdiff_t rest = p;
      for (int d = 0; d < D; ++d, rest /= finer) y[d] += ((static_cast<double>(rest % finer) + 0.5) / finer - 0.5) * h;
      sum += std::clamp(0.5 - scene.distance(y) * finer / h, 0.0, 1.0) / static_cast<double>(product(part));
    }
  }
  return sum * lattice.cell_volume();
}

/// Holds what a method left of a scene against it.
template <int D>
class Judge {
 public:
  explicit Judge(const Scene<D>& scene) : scene_(scene), volume_(volume_of(scene)) {
    const LevelSet<AsGiven, D> given(scene.lattice(), scene.phi);
    parts_ = measures(given.band()).inside_components;
  }

  Result operator()(const NarrowBand<double, D>& band) const {
    const double h = scene_.spacing();
    Result result;
    bool bad = false;
    for (std::size_t k = 0; k < band.lattice().size(); ++k) {
      const Index<D> node = band.lattice().node(k);
      const Vec<D> x = band.lattice().position(node);
      const double phi = band(node), exact = scene_.distance(x);
      bad |= !std::isfinite(phi) || ((phi < 0.0) != (exact < 0.0) && std::abs(exact) > 2.0 * h);
      if (std::abs(exact) < 3.0 * h && scene_.smooth(x)) {
        result.distance = std::max(result.distance, std::abs(phi - exact) / h);
      }
      result.drift = std::max(result.drift, displacement(band, node, phi));
    }
    try {
      const Measures<D> found = measures(band);
      result.parts = found.inside_components;
      result.volume = std::abs(found.volume - volume_) / found.area / h;
    } catch (const Error& error) {
      bad = true;
      result.error = error.what();
    }
    const double moved = std::max(result.drift, result.volume);
    const bool kept = moved < scene_.limits.drift && result.distance < scene_.limits.distance && result.parts == parts_;
    bad |= std::max(moved, result.distance) > broken;
    result.outcome = bad ? "broken" : kept ? "kept" : "degraded";
    return result;
  }

 private:
  /// Largest distance between the shape and the interface where it crosses the lattice lines ahead of a node.
  double displacement(const NarrowBand<double, D>& band, const Index<D>& node, double phi) const {
    double most = 0.0;
    for (int d = 0; d < D; ++d) {
      Index<D> ahead = node;
      if (++ahead[d] >= band.lattice().nodes()[d]) continue;
      const double next = band(ahead);
      if ((phi < 0.0) == (next < 0.0)) continue;
      Vec<D> x = band.lattice().position(node);
      x[d] += phi / (phi - next) * scene_.spacing();
      most = std::max(most, std::abs(scene_.distance(x)) / scene_.spacing());
    }
    return most;
  }

  const Scene<D>& scene_;
  double volume_;
  std::size_t parts_ = 0;
};

/// Runs f, which returns a judgement, and takes an error of the library for one.
template <class F>
Result outcome_of(F&& f) {
  try {
    return f();
  } catch (const Error& error) {
    return {.error = error.what()};
  }
}

/// Runs methods over scenes, prints and collects.
class Map {
 public:
  bool default_failed() const { return default_failed_; }
  nlohmann::json& rows() { return rows_; }

  template <class R, int D>
  void reinitialise(const std::string& method, const std::vector<Scene<D>>& scenes,
                    const typename R::Params& reinit = {}) {
    typename LevelSet<R, D>::Params params;
    params.reinit = reinit;
    for (const Scene<D>& scene : scenes) {
      note("reinitialisation", method, scene, outcome_of([&] {
             LevelSet<R, D> level_set(scene.lattice(), scene.phi, params);
             for (int call = 1; call < scene.calls; ++call) level_set.reinitialise();
             return Judge<D>(scene)(level_set.band());
           }));
    }
  }
  /// \param steps  of a turn
  template <class A, int D>
  void advect(const std::string& method, int steps, const std::vector<Scene<D>>& scenes,
              const typename A::Params& params = {}) {
    const auto turning = [](const Vec<D>& x, double) {
      Vec<D> u{};
      u[0] = 2.0 * std::numbers::pi * (0.5 - x[1]);
      u[1] = 2.0 * std::numbers::pi * (x[0] - 0.5);
      return u;
    };
    for (const Scene<D>& scene : scenes) {
      if (scene.calls > 1) continue;
      note("advection", method, scene, outcome_of([&] {
             LevelSet<ClosestPoint, D> level_set(scene.lattice(), scene.phi);
             A advection(params);
             for (int n = 0; n < steps; ++n) {
               advection.step(level_set, turning, static_cast<double>(n) / steps, 1.0 / steps);
             }
             level_set.reinitialise();
             return Judge<D>(scene)(level_set.band());
           }));
    }
  }

 private:
  template <int D>
  void note(const char* kind, const std::string& method, const Scene<D>& scene, const Result& result) {
    std::printf("| %s | %dD %s | %.3f | %.3f | %.3f | %zu | %s |\n", method.c_str(), D, scene.name.c_str(),
                result.drift, result.volume, result.distance, result.parts, result.outcome.c_str());
    std::fflush(stdout);
    const bool is_default = method == "ClosestPoint" || method == "Backward";
    default_failed_ |= is_default && (result.outcome == "broken" || result.outcome == "error");
    nlohmann::json row{
        {"kind", kind}, {"method", method}, {"dimension", D}, {"scene", scene.name}, {"outcome", result.outcome}};
    if (!result.error.empty()) row["error"] = result.error;
    if (result.outcome != "error") {
      row["drift"] = result.drift;
      row["volume"] = result.volume;
      row["distance"] = result.distance;
      row["parts"] = result.parts;
    }
    rows_.push_back(row);
  }

  nlohmann::json rows_ = nlohmann::json::array();
  bool default_failed_ = false;
};

template <int D>
void run(Map& map, std::ptrdiff_t n, int calls) {
  const std::vector<Scene<D>> scenes{filament<D>(n), touching<D>(n),        pinch<D>(n), corner<D>(n),
                                     scaled<D>(n),   repeated<D>(n, calls), noisy<D>(n)};
  map.reinitialise<ClosestPoint>("ClosestPoint", scenes);
  map.advect<Backward<>>("Backward", 8, scenes, {.substeps = 4});
#if !BENCH_SMOKE
  map.reinitialise<FastMarching<>>("FastMarching", scenes);
  map.reinitialise<FastSweeping<>>("FastSweeping", scenes);
  map.reinitialise<GroupMarching<>>("GroupMarching", scenes);
  map.reinitialise<GroupMarching<LinearKickOff>>("GroupMarching, linear kick-off", scenes);
  map.reinitialise<PdeReinit<>>("PdeReinit", scenes);
  map.reinitialise<PdeReinit<>>("PdeReinit, volume constraint", scenes, {.volume_constraint = true});
  map.reinitialise<PdeReinit<>>("PdeReinit, Russo-Smereka", scenes, {.subcell_fix = SubcellFix::russo_smereka});
  map.reinitialise<PdeReinit<>>("PdeReinit, high order", scenes, {.subcell_fix = SubcellFix::high_order});
  map.reinitialise<GradientNormalised>("GradientNormalised", scenes);
  map.reinitialise<LagrangianReinit<>>("LagrangianReinit", scenes);
  map.reinitialise<UpwindLagrangianReinit<>>("UpwindLagrangianReinit", scenes);
  map.advect<Lagrangian<>>("Lagrangian", 16, scenes);
  map.advect<Eulerian<>>("Eulerian", 16, scenes);
  map.advect<ParticleCorrected<>>("ParticleCorrected", 32, scenes);
#endif
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  std::ptrdiff_t flat = 48, deep = 32;
  int calls = 1000, calls_deep = 100;
  std::string json;
  CLI::App app("Where reinitialisations and advections of level sets fail");
  app.add_option("--cells-2d", flat, "cells along an axis in 2D");
  app.add_option("--cells-3d", deep, "cells along an axis in 3D (0: leave 3D out)");
  app.add_option("--calls", calls, "calls of the scene of repeated calls in 2D");
  app.add_option("--calls-3d", calls_deep, "and in 3D");
  app.add_option("--json", json, "write the results to this file");
  CLI11_PARSE(app, argc, argv);

  bench::Map map;
  std::printf(
      "| method | scene | drift, h | volume, h | distance, h | parts | outcome |\n|---|---|---|---|---|---|---|\n");
  bench::run<2>(map, flat, calls);
  if (deep > 0) bench::run<3>(map, deep, calls_deep);
  if (!json.empty()) {
    bench::write_json(json, {{"cells_2d", flat}, {"cells_3d", deep}, {"runs", map.rows()}});
  }
  if (map.default_failed()) std::printf("the defaults must not break\n");
  return map.default_failed() ? 1 : 0;
}
