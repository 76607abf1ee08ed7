// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Viscous vortices in the plane by vortex particles: they carry circulation, a Poisson equation on the lattice gives
// the velocity that moves them, the lattice Laplacian of the vorticity gives what viscosity does to them. Two solutions
// of the Navier-Stokes equations in a periodic box tell the error: a Lamb-Oseen vortex and a Taylor-Green flow, both
// carried across the box by a mean flow, so that lattice and vortices do not fit in any special way.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <cambium/cambium.hpp>

#include "command_line.hpp"

using namespace cambium;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double nu = 4e-4;
constexpr double duration = 1.0;
constexpr Vec<2> mean_flow{1.0, 0.5};
const auto domain = Domain<2>::periodic_box(Box<2>::cube());

/// A Lamb-Oseen vortex inside one of opposite circulation. Each spreads as w = G / (pi c) exp(-r^2 / c), c = c_0 + 4 nu
/// t; round flows do not interact. A periodic box has no room for circulation: a single vortex would stand in the
/// velocity of its images and of a uniform counter-vorticity. With circulation zero the flow ends with the Gaussian:
/// half a box away vorticity and velocity are below 1e-13 of their largest values at all times, and images do not
/// matter.
struct LambOseen {
  static constexpr const char* name = "lamb_oseen";
  static double vorticity(const Vec<2>& x, double t) {
    const Vec<2> r = domain.difference(Vec<2>{0.5, 0.25} + mean_flow * t, x);
    const auto layer = [&](double c) { return std::exp(-dot(r, r) / c) / (pi * c); };
    return 0.3 * (layer(0.0025 + 4.0 * nu * t) - layer(0.0064 + 4.0 * nu * t));
  }
};

/// Four vortices that fill the box and hold each other: w = 4 cos(k x) cos(k y) exp(-2 nu k^2 t), k = 2 pi. Not
/// stronger: where they meet, the flow strains at the rate w / 2 and takes whatever is wrong apart as exp(w t / 2).
struct TaylorGreen {
  static constexpr const char* name = "taylor_green";
  static double vorticity(const Vec<2>& x, double t) {
    const Vec<2> r = (x - mean_flow * t) * (2.0 * pi);
    return 4.0 * std::cos(r[0]) * std::cos(r[1]) * std::exp(-8.0 * pi * pi * nu * t);
  }
};

struct Result {
  double error = 0.0;        // largest of the vorticity at the end, relative to its largest value
  double circulation = 0.0;  // largest mean vorticity that was found, relative to its largest value; exactly 0
  StepSize step;
};

/// The fields and plans of a vortex method; made once.
struct VortexMethod {
  explicit VortexMethod(const Lattice<2>& lattice)
      : vorticity(lattice),
        spread(lattice),
        velocity(lattice),
        // Interpolation at moving points conserves circulation but for the order of the method.
        poisson(lattice, {.mean = MeanPart::subtract}) {}

  /// Velocity and d(vorticity)/dt = nu Lap(vorticity) on the lattice; returns the mean vorticity.
  double solve() {
    const double mean = poisson.velocity(vorticity, velocity);
    for (Vec<2>& u : velocity.values()) u += mean_flow;
    CentredDifference<4>::laplacian(vorticity, spread);
    for (double& value : spread.values()) value *= nu;
    return mean;
  }

  Field<double, 2> vorticity;
  Field<double, 2> spread;
  Field<Vec<2>, 2> velocity;
  PeriodicPoisson<2> poisson;
  Interpolator<M6> interpolate;
};

template <class Flow>
Result run(std::ptrdiff_t cells, const std::string& folder) {
  const auto lattice = Lattice<2>::periodic_box(domain.box, cells);
  const double volume = lattice.cell_volume();
  VortexMethod method(lattice);
  Particles<2> particles(lattice.size());
  const auto circulation = particles.add<double>("circulation");
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    particles.positions().set(i, lattice.position(lattice.node(i)));
    method.vorticity[i] = Flow::vorticity(particles.positions()[i], 0.0);
    particles[circulation][i] = method.vorticity[i] * volume;
  }
  const double largest = std::ranges::max(method.vorticity.values(), {}, [](double w) { return std::abs(w); });
  if (!folder.empty()) write_npy(folder + "/" + Flow::name + "_start.npy", method.vorticity);

  Result result;
  const auto rate = [&](const auto& state, double, const auto& derivative) {
    const auto& [x, gamma] = state;
    const auto& [dx, dgamma] = derivative;
    method.interpolate.p2m(x, Columns<1, const double>(gamma), method.vorticity);
    for (double& value : method.vorticity.values()) value /= volume;
    result.circulation = std::max(result.circulation, std::abs(method.solve()) / largest);
    method.interpolate.m2p(method.velocity, x, dx);
    method.interpolate.m2p(method.spread, x, Columns<1, double>(dgamma));
    for (double& value : dgamma) value *= volume;
  };

  method.solve();
  RK4<std::tuple<Columns<2, double>, std::span<double>>> stepper;
  // Particles do not need the second limit; it refines time along with space, so that the order of both shows.
  result.step = smallest({strain_limit(0.2, largest_gradient(method.velocity)),
                          advection_limit(1.0, lattice.spacing(), largest_norm(method.velocity)),
                          diffusion_limit(0.75, lattice.spacing(), nu, 2, stepper.real_axis)});
  const int steps = static_cast<int>(std::ceil(duration / result.step.dt));
  Remesher<M6> remesh;
  for (int n = 0; n < steps; ++n) {
    stepper.step({particles.positions(), particles[circulation]}, n * duration / steps, duration / steps, rate);
    remesh(particles, lattice, circulation);
  }
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    method.vorticity[i] = particles[circulation][i] / volume;
    const double exact = Flow::vorticity(particles.positions()[i], duration);
    result.error = std::max(result.error, std::abs(method.vorticity[i] - exact) / largest);
  }
  if (!folder.empty()) {
    write_npy(folder + "/" + Flow::name + "_end.npy", method.vorticity);
    write_npy(folder + "/" + Flow::name + "_exact.npy",
              sample(lattice, [](const Vec<2>& x) { return Flow::vorticity(x, duration); }));
  }
  return result;
}

/// Runs a flow on all lattices and prints a table; true if the error falls as it should.
template <class Flow>
bool study(const std::vector<std::ptrdiff_t>& cells, const std::string& folder, nlohmann::json& table) {
  std::printf("%s\n%5s %10s %7s %18s   %s\n", Flow::name, "cells", "error", "order", "|mean vorticity|", "step");
  Result result;
  double order = 0.0;
  std::ptrdiff_t coarser = 0;
  for (const auto n : cells) {
    const double before = result.error;
    result = run<Flow>(n, n == cells.back() ? folder : "");
    const double ratio = static_cast<double>(n) / static_cast<double>(coarser);
    order = coarser > 0 ? std::log(before / result.error) / std::log(ratio) : 0.0;
    coarser = n;
    std::printf("%5td %10.2e %7.2f %18.1e   %.4f, bound by %s\n", n, result.error, order, result.circulation,
                result.step.dt, name(result.step.bound));
    table.push_back({{"flow", Flow::name}, {"cells", n}, {"error", result.error}});
  }
  return cells.size() < 2 || order > 3.5;
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::ptrdiff_t> cells{64, 128};
  std::string json;
  std::string folder;
  CLI::App app("Viscous vortices by vortex particles against exact solutions in a periodic box");
  app.add_option("--cells", cells, "cells along an axis, one run for each, from coarse to fine");
  app.add_option("--json", json, "write the errors to this file")->check(command_line::writable_file());
  app.add_option("--fields", folder, "write the fields of the last runs to this folder, for scripts/draw_vortices.py");
  CLI11_PARSE(app, argc, argv);

  if (!folder.empty()) std::filesystem::create_directories(folder);
  nlohmann::json table = nlohmann::json::array();
  const bool round = study<LambOseen>(cells, folder, table);
  const bool square = study<TaylorGreen>(cells, folder, table);
  if (!json.empty()) command_line::write_text(json, nlohmann::json{{"runs", table}}.dump(2));
  if (!round || !square) std::printf("the error does not fall as the fourth power of the spacing\n");
  return round && square ? 0 : 1;
} catch (const std::exception& error) {
  return command_line::failed(error);
}
