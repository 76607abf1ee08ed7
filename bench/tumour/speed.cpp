// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <numbers>

#include <cambium/levelset/shapes/ball.hpp>

#include "tumour/grow.hpp"
#include "tumour/verification.hpp"

namespace bench {
namespace {

using nlohmann::json;
using namespace cambium;

constexpr double radius = 2.0;

/// V of a ball that only grows: G (c'(R) - A R / D), c being the nutrient at rest.
template <int D>
double exact(const TumourParameters& p) {
  const double slope =
      D == 2 ? std::cyl_bessel_i(1.0, radius) / std::cyl_bessel_i(0.0, radius) : 1.0 / std::tanh(radius) - 1.0 / radius;
  return p.growth * (slope - p.apoptosis * radius / D);
}

/// Mean error of V over the nodes next to the interface, each weighted by what is left of a spacing.
template <class T>
double mean_error(const T& tumour, double wanted) {
  const auto& band = tumour.level_set().band();
  double sum = 0.0, weight = 0.0;
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      const double distance = band.values().block(b)[i] / band.spacing();
      if (!(std::abs(distance) < 1.0)) continue;
      const double share = 1.0 + std::cos(std::numbers::pi * distance);
      sum += share * (tumour.speed().block(b)[i] - wanted);
      weight += share;
    }
  }
  return sum / weight;
}

/// Of three places on the lattice.
template <int D, class Outside>
json run(const char* outside, bool grows, std::ptrdiff_t cells, const TumourOptions& options) {
  TumourParameters parameters{.tension = grows ? 0.0 : options.tension_or(1.0)};
  if (!grows) parameters.growth = 0.0;
  double error = 0.0;
  for (const double off : {0.0, 0.137, 0.31}) {
    Vec<D> centre;
    for (int d = 0; d < D; ++d) centre[d] = off * (1.0 + 0.3 * d) * 12.0 / static_cast<double>(cells);
    const Tumour<D, Outside> tumour(tumour_box<D>(cells, 6.0), Ball<D>(centre, radius), {.parameters = parameters},
                                    OpenMP{options.threads});
    error += mean_error(tumour, exact<D>(parameters)) / 3.0;
  }
  std::printf("speed  %dD %-11s %s  %4td cells  mean error %9.2e of %.4f\n", D, outside,
              grows ? "growth alone " : "tension alone", cells, error, exact<D>(parameters));
  std::fflush(stdout);
  return {{"scene", "speed"}, {"dimension", D}, {"outside", outside},
          {"grows", grows},   {"cells", cells}, {"error", error}};
}

template <int D>
void add(json& runs, std::ptrdiff_t cells, const TumourOptions& options) {
  for (const bool grows : {true, false}) {
    runs.push_back(run<D, FreeSpace>("FreeSpace", grows, cells, options));
    runs.push_back(run<D, ZeroOutside>("ZeroOutside", grows, cells, options));
  }
}

}  // namespace

json verify_speed(const TumourOptions& options) {
  json runs = json::array();
  if (options.dimension != 3) {
    for (const auto n : options.cells_or({64, 128, 256})) add<2>(runs, n, options);
  }
  if (options.dimension != 2) {
    for (const auto n : options.cells_or({32, 64, 128})) add<3>(runs, n, options);
  }
  return runs;
}

}  // namespace bench
