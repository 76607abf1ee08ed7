// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A blob in a vortex that winds it up into a filament and, from half time on, unwinds it again (LeVeque 1996).
// Particles follow the flow exactly but lose their neighbours: where they are far apart nothing is left between them.
// Remeshing puts them back on the lattice in every step. Without it the error at half time does not fall with the
// spacing; at the end it is nil all the same, because every particle has come home: a test that fools who looks only
// there.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <cambium/cambium.hpp>

#include "command_line.hpp"

using namespace cambium;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double period = 8.0;

/// Stream function cos(pi t / T) sin^2(pi x) sin^2(pi y) / pi: the flow turns back at t = T / 2.
Vec<2> velocity(const Vec<2>& x, double t) {
  const double sx = std::sin(pi * x[0]), cx = std::cos(pi * x[0]);
  const double sy = std::sin(pi * x[1]), cy = std::cos(pi * x[1]);
  return Vec<2>{sx * sx * sy * cy, -sy * sy * sx * cx} * (2.0 * std::cos(pi * t / period));
}

/// A bell at (0.5, 0.75) that vanishes beyond a radius of 0.25, five times differentiable.
double blob(const Vec<2>& x) {
  const Vec<2> r = (x - Vec<2>{0.5, 0.75}) / 0.25;
  return dot(r, r) < 1.0 ? std::pow(1.0 - dot(r, r), 6) : 0.0;
}

/// Advances positions from t to t + duration in `steps` steps and calls after_each_step().
template <class F>
void follow(Particles<2>& particles, double t, double duration, int steps, F&& after_each_step) {
  RK4<Columns<2, double>> stepper;
  const double dt = duration / steps;
  for (int n = 0; n < steps; ++n) {
    stepper.step(particles.positions(), t + n * dt, dt, [](auto x, double time, auto u) {
      for_each(OpenMP{}, x.size(), [&](std::size_t p) { u.set(p, velocity(x[p], time)); });
    });
    after_each_step();
  }
}

/// A particle at every node.
Particles<2> at_nodes(const Lattice<2>& lattice) {
  Particles<2> particles(lattice.size());
  for (std::size_t i = 0; i < lattice.size(); ++i) particles.positions().set(i, lattice.position(lattice.node(i)));
  return particles;
}

/// The exact values at half time: those of the points the nodes came from. Time is turned round, T/2 + s for T/2 - s:
/// the flow is then the same one, for cos(pi t / T) is odd about T / 2.
Field<double, 2> exact_at_half_time(const Lattice<2>& lattice, int steps) {
  Particles<2> points = at_nodes(lattice);
  follow(points, period / 2.0, period / 2.0, steps, [] {});
  Field<double, 2> values(lattice);
  for (std::size_t i = 0; i < lattice.size(); ++i) values[i] = blob(points.positions()[i]);
  return values;
}

/// Distance of two fields, relative to the second, in the root-mean-square sense.
double distance(const Field<double, 2>& a, const Field<double, 2>& b) {
  double difference = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += (a[i] - b[i]) * (a[i] - b[i]);
    size += b[i] * b[i];
  }
  return std::sqrt(difference / size);
}

struct Errors {
  double half = 0.0;  ///< at half time, against exact_at_half_time()
  double end = 0.0;   ///< at the end, against the blob
};

template <class Kernel>
Errors run(std::ptrdiff_t cells, bool remeshed, const std::string& folder) {
  const auto lattice = Lattice<2>::periodic_box(Box<2>::cube(), cells);
  const double volume = lattice.cell_volume();
  const auto start = sample(lattice, blob);

  Particles<2> particles = at_nodes(lattice);
  const auto strength = particles.add<double>("strength");
  for (std::size_t i = 0; i < lattice.size(); ++i) particles[strength][i] = start[i] * volume;
  particles.keep_if([&](std::size_t p) { return particles[strength][p] > 0.0; });

  // Paths must not cross: dt = C / |grad u|max, whatever the spacing. Lattice methods would need dt < h / |u|max.
  const int steps = static_cast<int>(std::ceil(period / 2.0 / strain_limit(0.3, 2.0 * pi).dt));
  Remesher<Kernel> remesh({.threshold = 1e-10 * volume});
  const auto after_a_step = [&] {
    if (remeshed) remesh(particles, lattice, strength);
  };
  const auto values = [&] {
    Field<double, 2> mesh(lattice);
    p2m<Kernel>(particles, strength, mesh);
    for (double& value : mesh.values()) value /= volume;
    return mesh;
  };
  follow(particles, 0.0, period / 2.0, steps, after_a_step);
  const auto half = values();
  const std::string name = folder + (remeshed ? "/remeshed_" : "/scattered_");
  if (!folder.empty()) write_npy(name + "particles.npy", std::as_const(particles).positions());
  follow(particles, period / 2.0, period / 2.0, steps, after_a_step);
  const auto end = values();
  const auto exact = exact_at_half_time(lattice, 2 * steps);
  if (!folder.empty()) {
    write_npy(folder + "/start.npy", start);
    write_npy(folder + "/exact_half.npy", exact);
    write_npy(name + "half.npy", half);
    write_npy(name + "end.npy", end);
  }
  return {distance(half, exact), distance(end, start)};
}

}  // namespace

int main(int argc, char** argv) try {
  const std::map<std::string, std::function<Errors(std::ptrdiff_t, bool, const std::string&)>> kernels{
      {"m4prime", run<M4Prime>}, {"m6", run<M6>}};
  std::vector<std::ptrdiff_t> cells{64, 128};
  std::string kernel = "m6";
  std::string json;
  std::string folder;
  CLI::App app("A blob wound up by a vortex and unwound again, with and without remeshing");
  app.add_option("--cells", cells, "cells along an axis, one run for each, from coarse to fine");
  app.add_option("--kernel", kernel, "remeshing kernel")->check(CLI::IsMember(kernels));
  app.add_option("--json", json, "write the errors to this file")->check(command_line::writable_file());
  app.add_option("--fields", folder, "write the fields of the last run to this folder, for scripts/draw_swirl.py");
  CLI11_PARSE(app, argc, argv);

  nlohmann::json table = nlohmann::json::array();
  Errors remeshed;
  Errors scattered;
  double order = 0.0;
  std::printf("relative errors, kernel %s\n%5s %31s %25s\n", kernel.c_str(), "", "remeshed in every step",
              "never remeshed");
  std::printf("%5s %10s %10s %9s %12s %12s\n", "cells", "t = T/2", "order", "t = T", "t = T/2", "t = T");
  for (const auto n : cells) {
    const std::string to = n == cells.back() ? folder : "";
    if (!to.empty()) std::filesystem::create_directories(to);
    const double before = remeshed.half;
    remeshed = kernels.at(kernel)(n, true, to);
    scattered = kernels.at(kernel)(n, false, to);
    order = before > 0.0 ? std::log2(before / remeshed.half) : 0.0;
    std::printf("%5td %10.2e %10.2f %9.1e %12.2e %12.1e\n", n, remeshed.half, order, remeshed.end, scattered.half,
                scattered.end);
    table.push_back({{"cells", n},
                     {"remeshed_half", remeshed.half},
                     {"remeshed_end", remeshed.end},
                     {"scattered_half", scattered.half},
                     {"scattered_end", scattered.end}});
  }
  if (!json.empty()) command_line::write_text(json, nlohmann::json{{"kernel", kernel}, {"runs", table}}.dump(2));
  // With remeshing the error falls as the filament comes to be resolved; without, it stays.
  const bool falls = cells.size() < 2 || order > 0.8;
  const bool stays = scattered.half > 0.8 && scattered.half > 1.2 * remeshed.half;
  if (!falls || !stays) std::printf("this is not what remeshing should do\n");
  return falls && stays ? 0 : 1;
} catch (const std::exception& error) {
  return command_line::failed(error);
}
