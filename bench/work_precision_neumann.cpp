// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Error against time of diffusion in a closed geometry: the first radial mode of a disk and of a ball decays to half.
// Neumann with fluxes in the middle of open parts of faces or of whole faces (Crank and Nicolson, four cells of time
// for one step), and particles whose images behind the wall continue them (Euler, at the largest stable step). Times
// are processor times of one thread.
//
//     work_precision_neumann --json raw.json
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <cambium/interface/images.hpp>
#include <cambium/interface/neumann.hpp>
#include <cambium/kernels/gaussian_pse.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/operators/pse.hpp>
#include <cambium/particles/particles.hpp>

#include "support/clock.hpp"
#include "support/command.hpp"

using namespace cambium;

namespace bench {
namespace {

/// u = exp(-k^2 t) m(k r), dm/dr = 0 at the wall: J_0 in 2D, sin(k r) / (k r) in 3D.
template <int D>
struct Mode {
  static constexpr double radius = 0.25;
  static constexpr double k = (D == 2 ? 3.831705970207512 : 4.493409457909064) / radius;
  static inline const double end = std::log(2.0) / (k * k);
  Vec<D> centre = Vec<D>::constant(0.5) + Vec<D>::unit(0, 0.003) - Vec<D>::unit(1, 0.0071);

  double start(const Vec<D>& x) const {
    const double r = k * norm(x - centre);
    if constexpr (D == 2) return std::cyl_bessel_j(0.0, r);
    return r > 1e-9 ? std::sin(r) / r : 1.0;
  }
};

/// Largest error at the end, drift of the total relative to the integral of |u|, and time.
struct Outcome {
  double error = 0.0;
  double drift = 0.0;
  double seconds = 0.0;
  int steps = 0;
};

template <class Flux, int D>
Outcome by_neumann(std::ptrdiff_t cells) {
  const Mode<D> mode;
  const Ball<D> ball(mode.centre, mode.radius);
  const auto lattice = Lattice<D>::bounded_box(Box<D>::cube(), cells);
  const LevelSet<ClosestPoint, D> level_set(lattice, ball);
  auto u = sample(lattice, [&](const Vec<D>& x) { return mode.start(x); });
  const auto initial = u;
  const Field<double, D> source(lattice);
  const auto closed = [](const Vec<D>&) { return 0.0; };
  Outcome result;
  result.steps = static_cast<int>(cells) / 4;
  const double dt = mode.end / result.steps;
  const double begin = cpu_seconds();
  Neumann<D, Flux, double, Serial> neumann(level_set.band(), {.shift = 2.0 / dt, .tolerance = 1e-8});
  const double before = neumann.total(u);
  for (int s = 0; s < result.steps; ++s) neumann.step(u, source, closed, 1.0, dt, 0.5);
  result.seconds = cpu_seconds() - begin;
  auto size = u;
  for (std::size_t i = 0; i < u.size(); ++i) {
    size[i] = std::abs(initial[i]);
    if (ball(lattice.position(lattice.node(i))) < 0.0) {
      result.error = std::max(result.error, std::abs(u[i] - 0.5 * initial[i]));
    }
  }
  result.drift = std::abs(neumann.total(u) - before) / neumann.total(size);
  return result;
}

template <int D>
Outcome by_images(std::ptrdiff_t cells) {
  const Mode<D> mode;
  const Ball<D> ball(mode.centre, mode.radius);
  const auto lattice = Lattice<D>::bounded_box(Box<D>::cube(), cells);
  const double h = lattice.spacing(), v = std::pow(h, D);
  const PSE<GaussianPSE<2>> pse(1.5 * std::pow(h, 0.9), 4.0);
  const LevelSet<ClosestPoint, D> level_set(lattice, ball, {.half_width = pse.radius() / h + 1.0});
  Particles<D> particles;
  const auto volume = particles.template add<double>("volume", v);
  std::vector<Vec<D>> places;
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const Vec<D> x = lattice.position(lattice.node(i));
    if (ball(x) < 0.0) places.push_back(x);
  }
  particles.resize(places.size());
  std::vector<double> strength(places.size()), all, rate;
  double before = 0.0, size = 0.0;
  for (std::size_t p = 0; p < places.size(); ++p) {
    particles.positions().set(p, places[p]);
    strength[p] = v * mode.start(places[p]);
    before += strength[p];
    size += std::abs(strength[p]);
  }
  Outcome result;
  const double begin = cpu_seconds();
  const auto& constant = particles;
  Images<D> images(pse.radius());
  images.update(level_set.band(), lattice.domain(), constant.positions(), constant[volume], Serial{});
  const auto op = pse.at(lattice.domain(), images.positions(), images.volumes(), Serial{});
  result.steps = static_cast<int>(std::ceil(mode.end / pse.template stable_step<D>(1.0)));
  const double dt = mode.end / result.steps;
  rate.resize(images.size());
  for (int s = 0; s < result.steps; ++s) {
    images.extend(std::span<const double>(strength), all);
    op.laplacian(all, rate);
    for (std::size_t p = 0; p < strength.size(); ++p) strength[p] += dt * rate[p];
  }
  result.seconds = cpu_seconds() - begin;
  double after = 0.0;
  for (std::size_t p = 0; p < places.size(); ++p) {
    after += strength[p];
    result.error = std::max(result.error, std::abs(strength[p] / v - 0.5 * mode.start(places[p])));
  }
  result.drift = std::abs(after - before) / size;
  return result;
}

void enter(int dimension, std::ptrdiff_t cells, const char* method, const Outcome& run, nlohmann::json& table) {
  std::printf("%dD %4td %-22s error %.2e, total drifts by %.1e, %4d steps, %.3g s\n", dimension, cells, method,
              run.error, run.drift, run.steps, run.seconds);
  table.push_back({{"dimension", dimension},
                   {"cells", cells},
                   {"method", method},
                   {"error", run.error},
                   {"drift", run.drift},
                   {"steps", run.steps},
                   {"cpu_seconds", run.seconds}});
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  std::vector<std::ptrdiff_t> flat{32, 64, 128, 256}, deep{24, 48, 96}, flat_images{48, 96, 192}, deep_images{48, 64};
  bench::Command command("Error against time of diffusion in a closed geometry");
  command.app.add_option("--resolutions", flat, "cells along an axis in 2D");
  command.app.add_option("--resolutions-3d", deep, "cells along an axis in 3D");
  command.app.add_option("--resolutions-images", flat_images, "cells along an axis in 2D for particles with images");
  command.app.add_option("--resolutions-images-3d", deep_images, "cells along an axis in 3D for particles with images");
  CLI11_PARSE(command.app, argc, argv);
  if (command.quick) {
    flat = {32};
    flat_images = {48};
    deep = deep_images = {};
  }
  nlohmann::json table = nlohmann::json::array();
  for (const auto n : flat) bench::enter(2, n, "FaceCentroid", bench::by_neumann<FaceCentroid, 2>(n), table);
  for (const auto n : flat) bench::enter(2, n, "FaceCentre", bench::by_neumann<FaceCentre, 2>(n), table);
  for (const auto n : flat_images) bench::enter(2, n, "PSE with images", bench::by_images<2>(n), table);
  if constexpr (BENCH_SMOKE == 0) {
    for (const auto n : deep) bench::enter(3, n, "FaceCentroid", bench::by_neumann<FaceCentroid, 3>(n), table);
    for (const auto n : deep) bench::enter(3, n, "FaceCentre", bench::by_neumann<FaceCentre, 3>(n), table);
    for (const auto n : deep_images) bench::enter(3, n, "PSE with images", bench::by_images<3>(n), table);
  }
  command.write({{"runs", table}});
  return 0;
}
