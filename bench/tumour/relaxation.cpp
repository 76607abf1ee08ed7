// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <numbers>

#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/levelset/surface.hpp>

#include "tumour/grow.hpp"
#include "tumour/verification.hpp"
#include "tumour/wave.hpp"

namespace bench {
namespace {

using nlohmann::json;
using namespace cambium;
using Relaxing = Tumour<3, SemiImplicit>;

/// Largest speed next to the interface.
double largest_speed(const Relaxing& tumour) { return tumour.next_step(1.0).largest_speed; }

json ball_at_rest(std::ptrdiff_t cells, const TumourOptions& options) {
  Relaxing tumour(tumour_box<3>(cells, 6.0), Ball<3>(Wave<3>::centre(), 2.0),
                  {.parameters = TumourParameters::relaxing(options.tension_or(1.0))}, OpenMP{options.threads});
  const Measures<3> before = measures(tumour.level_set().band());
  const double speed = largest_speed(tumour);
  json result;
  for (int step = 1; step <= 100; ++step) result = grow(tumour, 0.01 * options.end_or(1.0) * step);
  const Measures<3> after = measures(tumour.level_set().band());
  const double radius = std::cbrt(0.75 * after.volume / std::numbers::pi);
  const double drift = after.volume / before.volume - 1.0;
  // As means of the two principal curvatures, relative to 1 / R.
  const double least = 0.5 * after.least_curvature * radius - 1.0, most = 0.5 * after.greatest_curvature * radius - 1.0;
  result.update({{"scene", "ball at rest"},
                 {"drift", drift},
                 {"start", before.volume / (32.0 / 3.0 * std::numbers::pi) - 1.0},
                 {"least_curvature", least},
                 {"greatest_curvature", most},
                 {"first_speed", speed},
                 {"last_speed", largest_speed(tumour)}});
  std::printf(
      "ball at rest  %4td cells  t = %.3f, %d steps  volume %9.2e  curvature %9.2e to %9.2e  speed %9.2e, "
      "%9.2e at first\n",
      cells, tumour.time(), 100, drift, least, most, largest_speed(tumour), speed);
  std::fflush(stdout);
  return result;
}

/// Height of the wave, from the vertices of the interface.
double height(const Relaxing& tumour, const Wave<3>& wave) {
  WaveFit fit;
  for (const auto& x : extract_surface(tumour.level_set().band()).vertices) {
    fit.add(wave(x), norm(x - wave.centre()));
  }
  return fit.part();
}

/// Waves of l = 2 upwards and downwards: half the difference has no part that is quadratic in their height.
json decay(std::ptrdiff_t cells, const TumourOptions& options) {
  const Wave<3> wave{2};
  const double gamma = options.tension_or(1.0), end = options.end_or(0.5), exact = -0.6 * gamma;
  double first = 0.0, last = 0.0, seconds = 0.0, volume = 0.0;
  for (const double delta : {0.05, -0.05}) {
    Relaxing tumour(
        tumour_box<3>(cells, 6.0), [&](const Vec<3>& x) { return wave.shape(x, delta); },
        {.parameters = TumourParameters::relaxing(gamma)}, OpenMP{options.threads});
    first += height(tumour, wave) / (2.0 * delta);
    volume = -measures(tumour.level_set().band()).volume;
    const json run = grow(tumour, end);
    volume += measures(tumour.level_set().band()).volume;
    last += height(tumour, wave) / (2.0 * delta);
    seconds += run["seconds"].get<double>();
  }
  const double found = std::log(last / first) / end, error = found / exact - 1.0;
  std::printf(
      "decay of l = 2  %4td cells  t = %.3f  height %.5f to %.5f  rate %.5f (%.5f), off by %.2f%%  volume %9.2e  "
      "%.1f s\n",
      cells, end, first, last, found, exact, 100.0 * error, volume, seconds);
  std::fflush(stdout);
  return {{"scene", "decay"}, {"cells", cells}, {"found", found}, {"exact", exact}, {"error", error}};
}

}  // namespace

json verify_relaxation(const TumourOptions& options) {
  json runs = json::array();
  for (const auto n : options.cells_or({32, 64})) {
    runs.push_back(ball_at_rest(n, options));
    runs.push_back(decay(n, options));
  }
  return runs;
}

}  // namespace bench
