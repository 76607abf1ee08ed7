// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A patch of heat that is turned, strained and spread: particles carry it along, particle strength exchange diffuses
// it, remeshing keeps the particles in order. In a linear flow u = A x the patch stays a Gaussian whose covariance S
// obeys dS/dt = A S + S A^T + 2 nu I, so the error is known at every moment.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include <cambium/cambium.hpp>

#include "command_line.hpp"

using namespace cambium;

namespace {

constexpr double strain = 2.0;
constexpr double rotation = 4.0;
constexpr double nu = 5e-3;
constexpr double variance = 0.01;  // at the start, in both directions
constexpr double duration = 1.0;

/// u = A x with A = (strain, -rotation; rotation, -strain): ellipses, for the rotation is the stronger.
Vec<2> velocity(const Vec<2>& x) { return {strain * x[0] - rotation * x[1], rotation * x[0] - strain * x[1]}; }

/// The exact solution. A^2 = -k^2 I, k^2 = rotation^2 - strain^2, so E = exp(A t) = cos(k t) I + sin(k t) / k A, and
/// S = variance E E^T + 2 nu int_0^t E E^T with E E^T = cos^2 I + cos sin / k (A + A^T) + sin^2 / k^2 A A^T.
struct Gaussian {
  double xx, xy, yy;  // covariance

  explicit Gaussian(double t) {
    const double k = std::sqrt(rotation * rotation - strain * strain);
    const double c = std::cos(k * t);
    const double s = std::sin(k * t);
    const double cos2 = variance * c * c + 2.0 * nu * (0.5 * t + std::sin(2.0 * k * t) / (4.0 * k));
    const double cross = (variance * c * s + nu * s * s / k) / k;
    const double sin2 = (variance * s * s + 2.0 * nu * (0.5 * t - std::sin(2.0 * k * t) / (4.0 * k))) / (k * k);
    const double square = strain * strain + rotation * rotation;  // A A^T = (square, 2 s r; 2 s r, square)
    xx = cos2 + 2.0 * strain * cross + square * sin2;
    yy = cos2 - 2.0 * strain * cross + square * sin2;
    xy = 2.0 * strain * rotation * sin2;
  }
  double operator()(const Vec<2>& x) const {
    const double determinant = xx * yy - xy * xy;
    const double exponent = (yy * x[0] * x[0] - 2.0 * xy * x[0] * x[1] + xx * x[1] * x[1]) / determinant;
    return std::exp(-0.5 * exponent) / (2.0 * std::numbers::pi * std::sqrt(determinant));
  }
};

struct Result {
  double error = 0.0;  // largest, relative to the largest exact value
  double total = 0.0;  // of the heat; 1 at the start
  StepSize step;
};

/// Runs on a box of length 2 around the origin and writes the field at `pictures` equal times if there is a folder.
Result run(std::ptrdiff_t cells, const std::string& folder, int pictures = 3) {
  const auto lattice = Lattice<2>::periodic_box({{-1.0, -1.0}, {1.0, 1.0}}, cells);
  const double volume = lattice.cell_volume();
  const PSE<Gaussian4> pse(lattice.spacing() / 0.6);  // particles overlap: h / epsilon = 0.6

  Particles<2> particles(lattice.size());
  const auto heat = particles.add<double>("heat");
  const auto volumes = particles.add<double>("volume", volume);
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    particles.positions().set(i, lattice.position(lattice.node(i)));
    particles[heat][i] = Gaussian(0.0)(particles.positions()[i]) * volume;
  }
  const auto rate = [&](const auto& state, double, const auto& derivative) {
    const auto& [x, q] = state;
    const auto& [dx, dq] = derivative;
    for (std::size_t p = 0; p < x.size(); ++p) dx.set(p, velocity(x[p]));
    pse.at(lattice.domain(), x, particles[volumes]).laplacian(q, dq);
    for (double& value : dq) value *= nu;
  };

  Result result;
  TVDRK3<std::tuple<Columns<2, double>, std::span<double>>> stepper;
  // The step shrinks with the spacing, so that the order of both shows. (A fixed one would leave an error that no
  // refinement of space takes away: particles strained by C in a step leave one of the order C^5.)
  result.step = smallest({strain_limit(6.0 / static_cast<double>(cells), strain + rotation),
                          exchange_limit(0.5, pse.epsilon(), nu, Gaussian4::order, stepper.real_axis)});
  const int steps = pictures * static_cast<int>(std::ceil(duration / pictures / result.step.dt));
  const double dt = duration / steps;
  Remesher<M6> remesh({.threshold = 1e-8 * volume});
  Field<double, 2> values(lattice);
  for (int n = 0; n <= steps; ++n) {
    remesh(particles, lattice, heat);
    if (n % (steps / pictures) == 0 && (n == steps || !folder.empty())) {
      p2m<M6>(particles, heat, values);
      for (double& value : values.values()) value /= volume;
      if (!folder.empty()) {
        const std::string number = std::to_string(n / (steps / pictures));
        write_npy(folder + "/heat_" + number + ".npy", values);
        write_npy(folder + "/exact_" + number + ".npy", sample(lattice, Gaussian(n * dt)));
      }
    }
    if (n < steps) stepper.step({particles.positions(), particles[heat]}, n * dt, dt, rate);
  }
  const Gaussian exact(duration);
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    result.error =
        std::max(result.error, std::abs(values[i] / exact({}) - exact(lattice.position(lattice.node(i))) / exact({})));
    result.total += values[i] * volume;
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::ptrdiff_t> cells{32, 64};
  std::string json;
  std::string folder;
  CLI::App app("A Gaussian patch in a turning and straining flow, diffused by particle strength exchange");
  app.add_option("--cells", cells, "cells along an axis, one run for each, from coarse to fine");
  app.add_option("--json", json, "write the errors to this file")->check(command_line::writable_file());
  app.add_option("--fields", folder, "write the fields of the last run to this folder, for scripts/draw_gaussian.py");
  CLI11_PARSE(app, argc, argv);

  if (!folder.empty()) std::filesystem::create_directories(folder);
  nlohmann::json table = nlohmann::json::array();
  Result result;
  double order = 0.0;
  std::printf("%5s %10s %7s %12s   %s\n", "cells", "error", "order", "1 - total", "step");
  std::ptrdiff_t coarser = 0;
  for (const auto n : cells) {
    const double before = result.error;
    result = run(n, n == cells.back() ? folder : "");
    order = coarser > 0
                ? std::log(before / result.error) / std::log(static_cast<double>(n) / static_cast<double>(coarser))
                : 0.0;
    coarser = n;
    std::printf("%5td %10.2e %7.2f %12.1e   %.4f, bound by %s\n", n, result.error, order, 1.0 - result.total,
                result.step.dt, name(result.step.bound));
    table.push_back({{"cells", n}, {"error", result.error}, {"total", result.total}});
  }
  if (!json.empty()) command_line::write_text(json, nlohmann::json{{"runs", table}}.dump(2));
  const bool accurate = cells.size() < 2 || order > 3.5;
  const bool conserved = std::abs(result.total - 1.0) < 1e-6;
  if (!accurate) std::printf("the error does not fall as the fourth power of the spacing\n");
  if (!conserved) std::printf("the total is not conserved\n");
  return accurate && conserved ? 0 : 1;
} catch (const std::exception& error) {
  return command_line::failed(error);
}
