// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Error against time of functions on interfaces: diffusion of Y_10 and Y_32 on the unit sphere until t = 0.5, on a
// sphere at rest and on one that turns and travels; the sphere that grows by u = n from R = 1 to 1.5 with c = 2 + Y_10,
// and an ellipsoid that grows by a known map. Times are processor times of one thread.
//
//     work_precision_surface --json raw.json     then scripts/draw_work_precision_surface.py raw.json
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <cambium/levelset/extension/by_pde.hpp>

#include "support/clock.hpp"
#include "support/command.hpp"
#include "support/surface/carrier.hpp"
#include "support/surface/particle_carrier.hpp"
#include "support/surface/rare_extension.hpp"

using namespace motion;

namespace bench {
namespace {

const Vec<3> centre = modes::centre<3>();

/// Errors of the values of a carrier, in the L2 norm over the interface and the largest.
template <int Order, class F>
nlohmann::json errors(Carrier<Order, 3>& carrier, F&& exact) {
  const auto& band = carrier.band;
  carrier.integral.fit(carrier.level_set, band, Serial{});
  Values difference(band.size());
  double largest = 0.0, along = 0.0, square = 0.0;
  for (std::size_t k = 0; k < band.size(); ++k) {
    const double value = exact(band.point(k));
    difference[k] = carrier.c[k] - value;
    largest = std::max(largest, std::abs(difference[k]));
    along += carrier.c[k] * value;
    square += value * value;
  }
  const double area = carrier.integral(Values(band.size(), 1.0));
  const double l2 = std::sqrt(carrier.integral(difference, [](double e) { return e * e; }) / area);
  return {{"l2", l2}, {"largest", largest}, {"amplitude", along / square}, {"values", band.size()}};
}

LevelSet<> sphere(double half_box, std::ptrdiff_t cells) {
  const auto lattice = Lattice<3>::bounded_box({Vec<3>::constant(-half_box), Vec<3>::constant(half_box)}, cells);
  return LevelSet<>(lattice, Ball<3>(centre, 1.0), {}, Serial{});
}

/// Errors over the amplitude that is left, the rate of decay over l (l + 1).
template <int Order>
nlohmann::json diffusion(std::ptrdiff_t cells, int l, double end) {
  Carrier<Order, 3> carrier(sphere(1.6, cells));
  const auto start = [&](const Vec<3>& x) { return modes::harmonic<3>(l, x - centre); };
  carrier.band.sample(start, carrier.c, Serial{});
  const double before = cpu_seconds();
  const int steps = carrier.diffuse(end, Serial{});
  const double seconds = cpu_seconds() - before;
  const double rate = modes::eigenvalue<3>(l);
  nlohmann::json run = errors(carrier, [&](const Vec<3>& x) { return std::exp(-rate * end) * start(x); });
  run["rate_error"] = std::abs(std::log(run["amplitude"].template get<double>()) / (rate * end));
  for (const char* name : {"l2", "largest"}) run[name] = run[name].template get<double>() * std::exp(rate * end);
  run.update({{"case", "diffusion"}, {"degree", l}, {"steps", steps}, {"seconds", seconds}});
  return run;
}

/// The same on a sphere that turns about the third axis and travels, in half steps of diffusion around the motion.
template <int Order>
nlohmann::json moving(std::ptrdiff_t cells, double speed, double end) {
  Carrier<Order, 3> carrier(sphere(2.1, cells));
  const auto start = [](const Vec<3>& x) { return modes::harmonic<3>(3, x - centre); };
  carrier.band.sample(start, carrier.c, Serial{});
  const Vec<3> travel{0.9, -0.6, 0.3};
  const int steps = static_cast<int>(cells) / 8;
  const double before = cpu_seconds();
  for (int s = 0; s < steps; ++s) {
    const auto u = [&](const Vec<3>& x, double t) {
      const Vec<3> r = x - centre - speed * t * travel;
      return speed * (travel + 3.0 * Vec<3>{-r[1], r[0], 0.0});
    };
    carrier.diffuse(0.5 * end / steps, Serial{});
    carrier.move(u, end / steps, Serial{});
    carrier.diffuse(0.5 * end / steps, Serial{});
  }
  const double seconds = cpu_seconds() - before;
  const double left = std::exp(-12.0 * end), angle = 3.0 * speed * end;
  nlohmann::json run = errors(carrier, [&](const Vec<3>& x) {
    const Vec<3> r = x - centre - speed * end * travel;
    return left * start(centre + Vec<3>{std::cos(angle) * r[0] + std::sin(angle) * r[1],
                                        std::cos(angle) * r[1] - std::sin(angle) * r[0], r[2]});
  });
  for (const char* name : {"l2", "largest"}) run[name] = run[name].template get<double>() / left;
  run.update({{"case", speed > 0.0 ? "moving" : "at rest"}, {"steps", steps}, {"seconds", seconds}});
  return run;
}

/// The sphere that grows by u = n, or an ellipsoid by the map x_d -> (1 + a_d t) x_d. For t = 0.5 both are maps by
/// factors 1 + a_d t, a_d = 1 for the sphere.
template <int Order>
nlohmann::json growing(std::ptrdiff_t cells, bool ellipsoid) {
  const Vec<3> rate = ellipsoid ? Vec<3>{0.5, -0.3, 0.2} : Vec<3>::constant(1.0);
  constexpr double end = 0.5;
  Carrier<Order, 3> carrier(sphere(2.05, cells));
  const auto start = [](const Vec<3>& x) { return 2.0 + modes::harmonic<3>(1, x - centre); };
  carrier.band.sample(start, carrier.c, Serial{});
  const double total = carrier.total();
  const int steps = static_cast<int>(cells) / 8;
  const auto u = [&](const Vec<3>& x, double t) {
    Vec<3> r = x - centre;
    if (!ellipsoid) return r / norm(r);
    for (int d = 0; d < 3; ++d) r[d] *= rate[d] / (1.0 + rate[d] * t);
    return r;
  };
  const double before = cpu_seconds();
  for (int s = 0; s < steps; ++s) carrier.move(u, end / steps, Serial{});
  const double seconds = cpu_seconds() - before;
  double place = 0.0;
  nlohmann::json run = errors(carrier, [&](const Vec<3>& x) {
    Vec<3> origin = x - centre, normal;
    double determinant = 1.0;
    for (int d = 0; d < 3; ++d) {
      origin[d] /= 1.0 + rate[d] * end;
      determinant *= 1.0 + rate[d] * end;
    }
    place = std::max(place, std::abs(norm(origin) - 1.0));
    for (int d = 0; d < 3; ++d) normal[d] = origin[d] / (norm(origin) * (1.0 + rate[d] * end));
    return start(centre + origin) / (determinant * norm(normal));
  });
  run.update({{"case", ellipsoid ? "ellipsoid" : "growing"},
              {"steps", steps},
              {"seconds", seconds},
              {"interface", place},
              {"mass", std::abs(carrier.total() / total - 1.0)}});
  return run;
}

template <int Order>
void run(std::ptrdiff_t cells, bool quick, nlohmann::json& runs) {
  const double end = quick ? 0.02 : 0.5;
  std::vector<nlohmann::json> rows{diffusion<Order>(cells, 1, end), diffusion<Order>(cells, 3, end),
                                   moving<Order>(cells, 0.0, 0.2), moving<Order>(cells, 1.0, 0.2)};
  rows.push_back(growing<Order>(cells, false));
  rows.push_back(growing<Order>(cells, true));
  for (nlohmann::json& row : rows) {
    row.update({{"cells", cells}, {"order", Order}});
    std::printf("%4td order %d %-10s %2d  L2 %.3e  largest %.3e  rate %.1e  interface %.2e  mass %.2e  %7.2f s\n",
                cells, Order, row["case"].get<std::string>().c_str(), row.value("degree", 0), row["l2"].get<double>(),
                row["largest"].get<double>(), row.value("rate_error", 0.0), row.value("interface", 0.0),
                row.value("mass", 0.0), row["seconds"].get<double>());
    std::fflush(stdout);
    runs.push_back(row);
  }
}

/// The projected operator at the nodes, with extensions after every so many steps of Euler.
nlohmann::json rare_extensions(bool quick) {
  nlohmann::json rows = nlohmann::json::array();
  constexpr int steps = 128;
  for (const int every : {1, 4, 16, 64, 2 * steps}) {
    if (quick) break;  // a test of its own has them
    const double by_point = modes::rare_extension_error<ByClosestPoint<>>(32, steps, every);
    const double by_pde = modes::rare_extension_error<ByPde<>>(32, steps, every);
    std::printf("projected operator, extension every %3d steps: error %.2e by closest points, %.2e by PDE\n", every,
                by_point, by_pde);
    rows.push_back({{"every", every}, {"closest_point", by_point}, {"pde", by_pde}});
  }
  return rows;
}

/// The growing sphere on particles, remeshed by M6 and extended by closest points after every step.
nlohmann::json on_particles(std::ptrdiff_t cells) {
  const double before = cpu_seconds();
  const auto [error, totals] = particles::growing_sphere<3>(cells, static_cast<int>(cells) / 8, 0.5, Serial{});
  const double seconds = cpu_seconds() - before;
  std::printf("%4td particles growing  largest %.3e  strengths %.1e  %7.2f s\n", cells, error, totals, seconds);
  return {{"cells", cells}, {"largest", error}, {"strengths", totals}, {"seconds", seconds}};
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  std::vector<std::ptrdiff_t> cells{40, 48, 56, 64};
  bench::Command command("Error against time of functions on interfaces");
  command.app.add_option("--cells", cells, "cells along an axis, one run for each");
  CLI11_PARSE(command.app, argc, argv);
  if (command.quick) cells = {40};
  nlohmann::json runs = nlohmann::json::array(), on_particles = runs;
  for (const auto n : cells) {
    on_particles.push_back(bench::on_particles(n));
    bench::run<2>(n, command.quick, runs);
#if !BENCH_SMOKE
    bench::run<4>(n, command.quick, runs);
#endif
  }
  const nlohmann::json rare = bench::rare_extensions(command.quick);
  command.write({{"runs", runs}, {"particles", on_particles}, {"rare_extensions", rare}});
  for (const auto& row : runs) {
    if (!(row["largest"].get<double>() < 0.1)) return 1;
  }
  return 0;
}
