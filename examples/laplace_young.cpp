// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A drop at rest: surface tension gamma makes the pressure inside higher by gamma times the curvature (Laplace and
// Young), and nothing should move. The tension as a jump of the pressure leaves the drop at rest; spread as a force by
// an immersed boundary it drives currents that are spurious, the part of the force that no pressure can balance.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include <cambium/interface.hpp>
#include <cambium/io.hpp>
#include <cambium/levelset.hpp>
#include <cambium/poisson.hpp>

#include "command_line.hpp"

using namespace cambium;

namespace {

constexpr double gamma = 1.0;
constexpr double radius = 0.25;

/// Curvature is to be found to the fifth order.
using Kernel = Lambda<6, 4>;
template <int D>
using Drop = LevelSet<BasicClosestPoint<Kernel>, D>;

/// Pressure, and the velocity that a unit of time of unbalanced force gives a fluid of density one.
template <int D>
struct State {
  explicit State(const Lattice<D>& lattice) : pressure(lattice), velocity(lattice) {}
  Field<double, D> pressure;
  Field<Vec<D>, D> velocity;

  double fastest() const {
    double result = 0.0;
    for (const Vec<D>& u : velocity.values()) result = std::max(result, norm(u));
    return result;
  }
};

template <int D>
Vec<D> centre() {  // off the nodes
  Vec<D> c;
  for (int d = 0; d < D; ++d) c[d] = 0.503 - 0.0047 * d;
  return c;
}

/// [p] = -gamma kappa, with the curvature that the level set has, and no other force.
template <int D>
State<D> by_jump(const Drop<D>& drop) {
  const Lattice<D>& lattice = drop.lattice();
  BandGeometry<double, D> geometry(lattice);
  typename AtClosestPoints<Kernel>::template Method<double, D>()(drop.band(), drop.method().points(), geometry,
                                                                 OpenMP{});
  for (std::size_t b = 0; b < geometry.mean.blocks(); ++b) {
    for (double& kappa : geometry.mean.block(b)) kappa *= -gamma;
  }
  Jump<D, double, Kernel> jump(lattice);
  jump.attach(drop.band(), drop.method().points());
  jump.set(geometry.mean);
  State<D> state(lattice);
  Field<double, D> f(lattice);
  jump.correct(f);
  PeriodicPoisson<D, SecondOrder>(lattice, {.mean = MeanPart::subtract}).solve(f, state.pressure);
  jump.gradient(state.pressure, state.velocity);
  for (Vec<D>& u : state.velocity.values()) u = -u;
  return state;
}

/// The force -gamma kappa n of the interface spread to the lattice, less the gradient of the pressure that balances
/// most of it: spectral derivatives, so that what is left is free of divergence to round-off.
template <int D>
State<D> by_immersed_boundary(const Drop<D>& drop) {
  const Lattice<D>& lattice = drop.lattice();
  ImmersedBoundary<D> boundary(lattice);
  boundary.attach(drop.band());
  Field<Vec<D>, D> force(lattice), derivatives(lattice);
  boundary.spread([](const InterfaceMarker<D>& m) { return -gamma * m.curvature * m.normal; }, force);
  PeriodicPoisson<D> poisson(lattice, {.mean = MeanPart::subtract});
  State<D> state(lattice);
  Field<double, D> along(lattice), source(lattice);
  for (int d = 0; d < D; ++d) {
    for (std::size_t i = 0; i < along.size(); ++i) along[i] = force[i][d];
    poisson.gradient(along, derivatives);
    for (std::size_t i = 0; i < source.size(); ++i) source[i] -= derivatives[i][d];
  }
  poisson.solve(source, state.pressure);
  poisson.gradient(state.pressure, state.velocity);
  for (std::size_t i = 0; i < source.size(); ++i) state.velocity[i] = force[i] - state.velocity[i];
  return state;
}

/// Pressure in the middle of the drop less that in the corner of the box, relative to what it should be, less one.
template <int D>
double jump_error(const Field<double, D>& pressure) {
  Index<D> middle;
  for (int d = 0; d < D; ++d) middle[d] = pressure.lattice().nodes()[d] / 2;
  return (pressure(middle) - pressure(Index<D>{})) * radius / (gamma * (D - 1)) - 1.0;
}

template <int D>
nlohmann::json run(std::ptrdiff_t cells, const std::string& folder, bool& good) {
  const auto lattice = Lattice<D>::periodic_box(Box<D>::cube(), cells);
  const Drop<D> drop(lattice, Ball<D>(centre<D>(), radius), {.half_width = 8.0});
  const State<D> jump = by_jump(drop), spread = by_immersed_boundary(drop);
  const double still = jump.fastest(), moving = spread.fastest();
  std::printf("%d %7td %6.1f %15.2e %15.2e %15.2e %15.2e\n", D, cells, radius / lattice.spacing(),
              jump_error(jump.pressure), jump_error(spread.pressure), still, moving);
  if constexpr (D == 2) {
    if (!folder.empty()) {
      std::filesystem::create_directories(folder);
      write_npy(folder + "/pressure_jump.npy", jump.pressure);
      write_npy(folder + "/pressure_spread.npy", spread.pressure);
      write_npy(folder + "/velocity_spread.npy", spread.velocity);
    }
  }
  // From 16 spacings a radius on: curvature is of third order, so that it and the pressure are much better than 1e-3.
  const bool resolved = radius >= 15.9 * lattice.spacing();
  if (resolved) good &= std::abs(jump_error(jump.pressure)) < 1e-3 && still < 0.01 * moving;
  return {{"dimension", D},
          {"cells", cells},
          {"pressure_error_jump", jump_error(jump.pressure)},
          {"pressure_error_spread", jump_error(spread.pressure)},
          {"spurious_jump", still},
          {"spurious_spread", moving}};
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::ptrdiff_t> cells{64};
  std::string json, folder;
  CLI::App app("A drop at rest under surface tension");
  app.add_option("--cells", cells, "cells along an axis, one run in 2D and one in 3D for each");
  app.add_option("--json", json, "write the figures to this file")->check(command_line::writable_file());
  app.add_option("--fields", folder, "write the last run in 2D to this folder, for scripts/draw_laplace_young.py");
  CLI11_PARSE(app, argc, argv);

  nlohmann::json runs = nlohmann::json::array();
  bool good = true;
  std::printf("D   cells    R/h   pressure: jump     spread       velocity: jump     spread\n");
  for (const auto n : cells) {
    runs.push_back(run<2>(n, n == cells.back() ? folder : "", good));
    runs.push_back(run<3>(n, "", good));
  }
  if (!json.empty()) command_line::write_text(json, nlohmann::json{{"runs", runs}}.dump(2));
  if (!good) std::printf("this is worse than the method should be\n");
  return good ? 0 : 1;
} catch (const std::exception& error) {
  return command_line::failed(error);
}
