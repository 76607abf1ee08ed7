// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Tumours against what is known of them: radial growth (an exact equation), the speed of small waves (linear
// stability), an ellipse at t = 1 (area of the true interface), and where the time of a step goes.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/models/tumour.hpp>

#include "support/clock.hpp"

using namespace cambium;

namespace {

template <int D>
Lattice<D> box(std::ptrdiff_t cells, double half) {
  return Lattice<D>::bounded_box({Vec<D>::constant(-half), Vec<D>::constant(half)}, cells);
}
Vec<2> centre() { return {0.05, 0.02}; }

/// Runs a tumour to a time; what it came to, or why it stopped.
template <class T>
nlohmann::json run(const char* scene, const char* policies, T& tumour, double end) {
  nlohmann::json result{{"scene", scene}, {"policies", policies}, {"cells", tumour.lattice().nodes()[0] - 1}};
  const double start = bench::wall_seconds();
  int steps = 0, iterations = 0;
  try {
    while (end - tumour.time() > 1e-12 && !tumour.extinct()) {
      iterations += tumour.step(end - tumour.time()).iterations;
      ++steps;
    }
  } catch (const Error& error) {
    result["stopped"] = error.what();
  }
  const auto& times = tumour.times();
  result["seconds"] = bench::wall_seconds() - start;
  result["time"] = tumour.time();
  result["steps"] = steps;
  result["iterations"] = iterations;
  result["volume"] = measures(tumour.level_set().band()).volume;
  result["parts"] = {{"geometry", times.geometry},
                     {"nutrient", times.nutrient},
                     {"pressure", times.pressure},
                     {"implicit", times.implicit},
                     {"motion", times.motion}};
  return result;
}

/// A disc of radius 2 with gamma = 1; R(end) is known.
template <class T>
nlohmann::json disc(const char* policies, std::ptrdiff_t cells, double end, double exact) {
  T tumour(box<2>(cells, 6.0), Ball<2>(centre(), 2.0));
  auto result = run("disc", policies, tumour, end);
  const double error = std::sqrt(result["volume"].template get<double>() / std::numbers::pi) / exact - 1.0;
  result["error"] = error;
  std::printf("disc    %-28s %4td cells  R(%g) off by %9.2e  %4d steps %5d iterations %7.2f s\n", policies, cells, end,
              error, result["steps"].template get<int>(), result["iterations"].template get<int>(),
              result["seconds"].template get<double>());
  return result;
}

/// (11.72) in the plane, e = 0.1, r = 2, gamma = 1: area at t = 1.
template <class T>
nlohmann::json ellipse(const char* policies, std::ptrdiff_t cells, double end, double exact) {
  T tumour(box<2>(cells, 6.0), [](const Vec<2>& x) { return std::hypot(1.1 * x[0], 0.9 * x[1]) - 2.0; });
  auto result = run("ellipse", policies, tumour, end);
  const auto area = result["volume"].template get<double>();
  result["error"] = area / exact - 1.0;
  std::printf("ellipse %-28s %4td cells  area %.5f at %.4f (%.4f at 1)  %4d steps %5d iterations %7.2f s\n", policies,
              cells, area, result["time"].template get<double>(), exact, result["steps"].template get<int>(),
              result["iterations"].template get<int>(), result["seconds"].template get<double>());
  return result;
}

/// What the speed has of cos(l theta), by least squares next to the interface, for r = 2 + delta cos(l theta).
template <class T>
double share_of_mode(std::ptrdiff_t cells, int l, double delta) {
  const auto mode = [l](const Vec<2>& x) { return std::cos(l * std::atan2(x[1] - centre()[1], x[0] - centre()[0])); };
  const T tumour(box<2>(cells, 6.0), [&](const Vec<2>& x) {
    const double r = norm(x - centre());
    return r < 0.1 ? r - 2.0 : r - 2.0 - delta * mode(x);
  });
  const auto& band = tumour.level_set().band();
  double count = 0.0, modes = 0.0, speeds = 0.0, squares = 0.0, products = 0.0;
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      if (std::abs(band.values().block(b)[i]) > band.spacing()) continue;
      const double y = mode(band.lattice().position(band.values().node(b, i)));
      const double v = tumour.speed().block(b)[i];
      count += 1.0;
      modes += y;
      speeds += v;
      squares += y * y;
      products += y * v;
    }
  }
  return (products - modes * speeds / count) / (squares - modes * modes / count);
}

/// Growth rate of a mode of the disc, exact to O(delta^4): from waves of two heights. Lower ones, of a fraction of a
/// spacing, are lost in what the interface itself is off by. \param tension_part  of the exact one
template <class T>
nlohmann::json rate(const char* policies, std::ptrdiff_t cells, int l, double exact, double tension_part) {
  constexpr double delta = 0.05;
  const auto at = [&](double height) {
    return (share_of_mode<T>(cells, l, height) - share_of_mode<T>(cells, l, -height)) / (2.0 * height);
  };
  const double found = (4.0 * at(delta) - at(2.0 * delta)) / 3.0;
  const double error = (found - exact) / std::max(std::abs(exact), std::abs(tension_part));
  std::printf("rate    %-28s %4td cells  l = %d  %9.4f (%9.4f), off by %6.2f%%\n", policies, cells, l, found, exact,
              100.0 * error);
  return {{"scene", "rate"}, {"policies", policies}, {"cells", cells}, {"l", l},
          {"found", found},  {"exact", exact},       {"error", error}};
}

/// All scenes on one lattice; a few of one composition alone unless Whole. \param rates  growth rates alone
template <bool Whole>
void run_scenes(std::ptrdiff_t n, bool rates, nlohmann::json& runs) {
  using Default = Tumour<2, SemiImplicit>;
  // Linear stability, R = 2, A = 0.5, G = 20, gamma = 1.
  constexpr double free_space[] = {0.492599428618, -0.141614086840, -2.07927492585, -5.61411627449, -11.0823123195};
  constexpr double zero[] = {-0.992547722405, -4.23872133296, -10.0917895906, -19.1392188675, -32.0533575372};
  for (int l = 2; l <= (Whole ? 6 : 3); ++l) {
    const double tension = -l * (l * l - 1) / 8.0;
    runs.push_back(rate<Default>("FreeSpace", n, l, free_space[l - 2], 0.5 * tension));
    if constexpr (Whole) {
      runs.push_back(rate<Tumour<2, SemiImplicit, ZeroOutside>>("ZeroOutside", n, l, zero[l - 2], tension));
    }
  }
  if (rates) return;
  runs.push_back(disc<Default>("FreeSpace SemiImplicit", n, 0.05, 2.18874642178));
  if constexpr (Whole) {
    using Zero = Tumour<2, SemiImplicit, ZeroOutside>;
    runs.push_back(disc<Default>("FreeSpace SemiImplicit", n, 1.0, 3.29084034377));
    runs.push_back(disc<Zero>("ZeroOutside SemiImplicit", n, 1.0, 3.29084034377));
    runs.push_back(disc<Tumour<2>>("FreeSpace AdamsBashforth", n, 0.05, 2.18874642178));
    runs.push_back(disc<Tumour<2, Heun>>("FreeSpace Heun", n, 0.05, 2.18874642178));
    runs.push_back(disc<Tumour<2, SemiImplicit, Necrosis>>("FreeSpace Necrosis", n, 0.2, 2.08881457151));
    runs.push_back(ellipse<Default>("FreeSpace SemiImplicit", n, 1.0, 35.1560));
    runs.push_back(ellipse<Zero>("ZeroOutside SemiImplicit", n, 1.0, 36.1939));
  }
}

}  // namespace

int main(int argc, char** argv) {
  bool quick = false, rates = false;
  std::vector<std::ptrdiff_t> cells{64, 128};
  std::string json;
  CLI::App app("Tumours: error against time");
  app.add_flag("--quick", quick, "48 cells");
  app.add_flag("--rates", rates, "growth rates of small waves alone");
  app.add_option("--cells", cells, "cells along an axis of a box of 12");
  app.add_option("--json", json, "write the figures to this file");
  CLI11_PARSE(app, argc, argv);
  if (quick) cells = {48};
  nlohmann::json runs = nlohmann::json::array();
  for (const auto n : cells) run_scenes<BENCH_SMOKE == 0>(n, rates, runs);
  if (!json.empty()) std::ofstream(json) << nlohmann::json{{"runs", runs}}.dump(2) << '\n';
  return 0;
}
