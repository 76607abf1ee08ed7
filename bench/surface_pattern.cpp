// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Patterns on spheres against what is known of them: growth rates of spherical harmonics against the dispersion
// relation, which pattern noise grows into, and what a steady pattern costs by different steppers.
//
//   surface_pattern --rates --selection --spectra --cost --json FILE
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/models.hpp>
#include <cambium/reaction.hpp>
#include <cambium/time.hpp>
#if !BENCH_SMOKE
#include <cambium/models/implicit_diffusion.hpp>
#endif

#include "support/clock.hpp"
#include "support/command.hpp"
#include "support/sphere_spectrum.hpp"

using namespace cambium;
using nlohmann::json;

namespace {

constexpr Vec<3> centre{0.0123, -0.0087, 0.0051};
using Surface = LevelSet<ClosestPoint, 3>;

/// A sphere in a cube whose walls are as near as the band allows: 7 cells.
Surface sphere(double radius, std::ptrdiff_t cells) {
  const double edge = 2.0 * (radius + 0.02) * static_cast<double>(cells) / (static_cast<double>(cells) - 15.0);
  const auto lattice = Lattice<3>::bounded_box({Vec<3>::constant(-0.5 * edge), Vec<3>::constant(0.5 * edge)}, cells);
  return {lattice, Ball<3>(centre, radius)};
}

/// The measured growth rate of degree l against the dispersion relation.
template <class K>
json growth_of_degree(const K& kinetics, const Vec<2>& diffusivity, double radius, std::ptrdiff_t cells, int l) {
  using Pattern = SurfacePattern<K, FixedSurface, StabilisedSteps, SurfaceLaplacian<4>>;
  const Vec<2> rest = kinetics.fixed_points()[0];
  const double k2 = l * (l + 1.0) / (radius * radius), exact = growth_rate(kinetics, rest, diffusivity, k2);
  const Vec<2> v = growing_direction(jacobian(kinetics, rest), diffusivity, k2, exact);
  Pattern pattern(sphere(radius, cells), kinetics, diffusivity, {}, {.steps = {.absolute = 1e-9, .relative = 0.0}});
  std::vector<double> value;
  const Vec<3> axes[3] = {{0.36, 0.48, -0.8}, {-0.8, 0.6, 0.0}, {0.48, 0.64, 0.6}};
  const auto mode = [&](const Vec<3>& x) {  // a mixture of all orders, turned against the lattice
    const Vec<3> from = x - centre;
    thread_local std::vector<double> y;
    bench::harmonics({dot(axes[0], from), dot(axes[1], from), dot(axes[2], from)}, l, y);
    double sum = 0.0;
    for (int m = -l; m <= l; ++m) sum += y[static_cast<std::size_t>(l * (l + 1) + m)] * std::cos(1.0 + m);
    return sum;
  };
  constexpr double small = 1e-5;
  pattern.sample([&](const Vec<3>& x) { return rest + (small * mode(x)) * v; });
  SurfaceIntegral<SurfaceLaplacian<4>> integral(pattern.surface(), pattern.band());
  AlignedVector<double> shape(pattern.band().size());
  pattern.band().sample(mode, shape);
  const auto amplitude = [&] {
    double sum = 0.0;
    for (std::size_t k = 0; k < shape.size(); ++k) {
      sum += integral.weights()[k] * shape[k] * (pattern.concentration(0)[k] - rest[0]);
    }
    return sum;
  };
  // The other eigenvalue of the degree decays first; then the mode grows by a factor of e.
  const double settle = 1.0 / std::abs(growth_rates(jacobian(kinetics, rest), diffusivity, k2)[1].real());
  pattern.advance(3.0 * settle);
  const double before = amplitude();
  const double time = std::min(1.0 / exact, 600.0);
  pattern.advance(time);
  const double measured = std::log(amplitude() / before) / time;
  std::printf("l = %2d: rate %.6e, exact %.6e, off by %+.3f%%\n", l, measured, exact, 100.0 * (measured / exact - 1.0));
  std::fflush(stdout);
  return {{"l", l}, {"measured", measured}, {"exact", exact}, {"cells", cells}};
}

json rates(std::ptrdiff_t cells, bool quick) {
  json result;
  const auto run = [&](const char* name, const auto& kinetics, const Vec<2>& d, double radius, int first, int last) {
    std::printf("%s, R = %g, %td cells\n", name, radius, cells);
    for (int l = first; l <= last; ++l) result[name].push_back(growth_of_degree(kinetics, d, radius, cells, l));
  };
  run("six spots", varea_spots, varea_diffusivities, 2.0, 4, 4);
  if (quick) return result;
  run("printed", varea_spots, varea_printed_diffusivities, 1.0, 1, 2);
  run("spots", koch_meinhardt_spots, koch_meinhardt_unit_diffusivities, 0.3, 3, 12);
  run("stripes", koch_meinhardt_stripes, koch_meinhardt_unit_diffusivities, 0.3, 4, 8);
  return result;
}

/// Runs until the pattern is steady: |dc/dt| below `still` of the range in a time unit, or to the end.
template <class P>
double run_to_rest(P& pattern, double end, double still) {
  std::array<AlignedVector<double>, 2> rate;
  for (auto& column : rate) column.resize(pattern.band().size());
  const Columns<2, double> to({rate[0].data(), rate[1].data()}, pattern.band().size());
  while (pattern.time() < end) {
    pattern.advance(std::min(100.0, end - pattern.time()));
    pattern.rate(pattern.state(), to);
    const auto [low, high] = std::ranges::minmax(pattern.concentration(0));
    double fastest = 0.0;
    for (const double r : rate[0]) fastest = std::max(fastest, std::abs(r));
    if (high - low > 5.0 && fastest < still * (high - low)) break;
  }
  return pattern.time();
}

/// Noise to its pattern. \param turn  angle by which the noise is turned about an oblique axis
/// The tolerance is far below the noise: waves that should decay while they oscillate must not be kept alive by long
/// steps whose error goes unseen.
template <class Stencil>
json selection_run(const Vec<2>& diffusivity, double radius, std::ptrdiff_t cells, int seed, double turn, double end,
                   double amplitude = 1e-3) {
  using Pattern = SurfacePattern<LinearisedBrusselator, FixedSurface, StabilisedSteps, Stencil>;
  Pattern pattern(sphere(radius, cells), varea_spots, diffusivity, {},
                  {.steps = {.absolute = 1e-3 * amplitude, .relative = 1e-3}});
  const bench::HarmonicNoise noise(static_cast<std::uint64_t>(seed), 12);
  const bench::HarmonicNoise other(static_cast<std::uint64_t>(seed) + 1000, 12);
  const Vec<3> axis{2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0};
  const auto turned = [&](const Vec<3>& x) {  // Rodrigues
    const Vec<3> r = x - centre;
    const Vec<3> side{axis[1] * r[2] - axis[2] * r[1], axis[2] * r[0] - axis[0] * r[2],
                      axis[0] * r[1] - axis[1] * r[0]};
    return std::cos(turn) * r + std::sin(turn) * side + (1.0 - std::cos(turn)) * dot(axis, r) * axis;
  };
  pattern.sample([&](const Vec<3>& x) { return amplitude * Vec<2>{noise(turned(x)), other(turned(x))}; });
  const double start = bench::cpu_seconds();
  const double rest = run_to_rest(pattern, end, 1e-6);
  const double seconds = bench::cpu_seconds() - start;
  SurfaceIntegral<Stencil> integral(pattern.surface(), pattern.band());
  const auto c = pattern.concentration(0);
  const auto a = bench::amplitudes(pattern.band(), integral.weights(), c, centre, 12);
  const auto power = bench::spectrum(a);
  const auto found = bench::spots(pattern.band(), integral.weights(), c, centre);
  const double off = bench::off_octahedron(found);
  const auto [low, high] = std::ranges::minmax(c);
  std::printf(
      "R %g, %td cells, order %d, seed %d, turned %.2f: t = %.0f, l = 4: %.1f%%, %zu spots, off octahedron %.2f, "
      "c1 in [%.3f, %.3f], %.1f s\n",
      radius, cells, Stencil::order, seed, turn, rest, 100.0 * power[4], found.size(), off, low, high, seconds);
  std::fflush(stdout);
  return {{"radius", radius},  {"cells", cells},        {"order", Stencil::order},
          {"seed", seed},      {"turn", turn},          {"time", rest},
          {"spectrum", power}, {"spots", found.size()}, {"angles", bench::pair_angles(found)},
          {"off", off},        {"range", {low, high}},  {"mean", a[0]},
          {"seconds", seconds}};
}

/// Every seed on every lattice, and turned against the coarsest.
template <class Stencil>
json selection(const std::vector<std::ptrdiff_t>& cells, int seeds, double end, double amplitude) {
  json result = json::array();
  for (int seed = 1; seed <= seeds; ++seed) {
    for (const std::ptrdiff_t n : cells) {
      result.push_back(selection_run<Stencil>(varea_diffusivities, 2.0, n, seed, 0.0, end, amplitude));
    }
    if (cells.size() > 1)
      result.push_back(selection_run<Stencil>(varea_diffusivities, 2.0, cells[0], seed, 1.0, end, amplitude));
  }
  return result;
}

/// What spots and stripes of Koch and Meinhardt on a sphere of radius 0.3 consist of, from noise about the rest state.
json spectra(std::ptrdiff_t cells, double end) {
  json result = json::array();
  const auto run = [&](const char* name, const KochMeinhardt& kinetics, int first, int last) {
    SurfacePattern<KochMeinhardt> pattern(sphere(0.3, cells), kinetics, koch_meinhardt_unit_diffusivities, {},
                                          {.steps = {.absolute = 1e-4, .relative = 1e-3}});
    const bench::HarmonicNoise noise(1, 12);
    const Vec<2> rest = kinetics.fixed_points()[0];
    pattern.sample([&](const Vec<3>& x) { return rest + Vec<2>{1e-2 * noise(x - centre), 0.0}; });
    const std::size_t evaluations = pattern.advance(end).evaluations;
    SurfaceIntegral<SurfaceLaplacian<2>> integral(pattern.surface(), pattern.band());
    const auto c = pattern.concentration(0);
    const auto power = bench::spectrum(bench::amplitudes(pattern.band(), integral.weights(), c, centre, 16));
    double in_band = 0.0;
    for (int l = first; l <= last; ++l) in_band += power[static_cast<std::size_t>(l)];
    const auto [low, high] = std::ranges::minmax(c);
    const double middle = 0.5 * (low + high), area = integral(c, [](double) { return 1.0; });
    const double above = integral(c, [&](double x) { return x > middle ? 1.0 : 0.0; }) / area;
    const std::size_t pieces = bench::spots(pattern.band(), integral.weights(), c, centre).size();
    std::printf(
        "%s, %td cells, t = %g: %.1f%% of the variance in l = %d to %d, %zu pieces above the middle, %.0f%% of "
        "the area, c1 in [%.3f, %.3f], %zu evaluations\n",
        name, cells, end, 100.0 * in_band, first, last, pieces, 100.0 * above, low, high, evaluations);
    std::fflush(stdout);
    result.push_back({{"name", name},
                      {"cells", cells},
                      {"time", end},
                      {"in_band", in_band},
                      {"spectrum", power},
                      {"pieces", pieces},
                      {"above", above},
                      {"range", {low, high}}});
  };
  run("spots", koch_meinhardt_spots, 3, 12);
  run("stripes", koch_meinhardt_stripes, 4, 8);
  return result;
}

/// The source's printed parameters, on the unit sphere.
json printed(std::ptrdiff_t cells, int seeds) {
  json result = json::array();
  for (int seed = 1; seed <= seeds; ++seed) {
    result.push_back(selection_run<SurfaceLaplacian<2>>(varea_printed_diffusivities, 1.0, cells, seed, 0.0, 400.0));
  }
  return result;
}

struct Run {
  Run(std::string of, double by) : name(std::move(of)), tolerance(by) {}
  std::string name;
  double tolerance;  ///< or the step
  double wall = 0.0, processor = 0.0;
  std::size_t evaluations = 0, steps = 0;
  std::array<std::vector<double>, 2> state;
  json bound_by;
};

/// One adaptive run from noise to the end.
template <class Steps>
Run adaptive_run(const char* name, std::ptrdiff_t cells, double tolerance, double end) {
  using Pattern = SurfacePattern<LinearisedBrusselator, FixedSurface, Steps>;
  Pattern pattern(sphere(2.0, cells), varea_spots, varea_diffusivities, {},
                  {.steps = {.absolute = tolerance, .relative = tolerance}});
  const SmoothNoise<3> noise(3, 6.0), other(1003, 6.0);
  pattern.sample([&](const Vec<3>& x) { return 1e-3 * Vec<2>{noise(x - centre), other(x - centre)}; });
  Run run(name, tolerance);
  const double wall = bench::wall_seconds();
  const double processor = bench::cpu_seconds();
  const AdaptiveReport report = pattern.advance(end);
  run.processor = bench::cpu_seconds() - processor;
  run.wall = bench::wall_seconds() - wall;
  run.evaluations = report.evaluations;
  run.steps = report.steps;
  for (std::size_t l = 0; l < limit_count; ++l) {
    if (report.bound_by[l] > 0) run.bound_by[cambium::name(static_cast<Limit>(l))] = report.bound_by[l];
  }
  for (int s = 0; s < 2; ++s)
    run.state[static_cast<std::size_t>(s)].assign(pattern.concentration(s).begin(), pattern.concentration(s).end());
  return run;
}

/// Explicit Euler at `fraction` of its stability limit, as the source stepped.
Run euler_run(std::ptrdiff_t cells, double fraction, double end) {
  SurfacePattern<LinearisedBrusselator> pattern(sphere(2.0, cells), varea_spots, varea_diffusivities);
  const SmoothNoise<3> noise(3, 6.0), other(1003, 6.0);
  pattern.sample([&](const Vec<3>& x) { return 1e-3 * Vec<2>{noise(x - centre), other(x - centre)}; });
  const double limit = 2.0 / (varea_diffusivities[1] * pattern.band().spectral_radius());
  const auto steps = static_cast<std::size_t>(std::ceil(end / (fraction * limit)));
  const double dt = end / static_cast<double>(steps);
  Run run("Euler", dt);
  run.steps = steps;
  using State = Columns<2, double>;
  FixedSteps<Euler, State> euler(FixedSteps<Euler, State>::Params{.check_every = 10000});
  const double wall = bench::wall_seconds();
  const double processor = bench::cpu_seconds();
  run.evaluations = euler.advance(pattern.state(), 0.0, dt, steps,
                                  [&](const auto& c, double, const auto& rate) { pattern.rate(c, rate); });
  run.processor = bench::cpu_seconds() - processor;
  run.wall = bench::wall_seconds() - wall;
  for (int s = 0; s < 2; ++s)
    run.state[static_cast<std::size_t>(s)].assign(pattern.concentration(s).begin(), pattern.concentration(s).end());
  return run;
}

/// Largest difference of the first species over the range of the reference.
double difference(const Run& a, const Run& b) {
  double largest = 0.0;
  const auto [low, high] = std::ranges::minmax(b.state[0]);
  for (std::size_t k = 0; k < a.state[0].size(); ++k)
    largest = std::max(largest, std::abs(a.state[0][k] - b.state[0][k]));
  return largest / (high - low);
}

json cost(std::ptrdiff_t cells, double end, bool quick) {
  const auto list = [&](const Run& run, const Run& reference) {
    const double error = difference(run, reference);
    std::printf("%-24s %10.2e  error %9.2e  %8zu evaluations %7zu steps  %8.2f s processor %8.2f s wall  %s\n",
                run.name.c_str(), run.tolerance, error, run.evaluations, run.steps, run.processor, run.wall,
                run.bound_by.dump().c_str());
    std::fflush(stdout);
    return json{{"name", run.name},
                {"cells", cells},
                {"tolerance", run.tolerance},
                {"error", error},
                {"evaluations", run.evaluations},
                {"steps", run.steps},
                {"processor", run.processor},
                {"wall", run.wall},
                {"bound_by", run.bound_by}};
  };
  json result = json::array();
  const Run reference = adaptive_run<StabilisedSteps>("RKC2, reference", cells, quick ? 1e-4 : 1e-7, end);
  result.push_back(list(reference, reference));
  for (const double tolerance : {3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5}) {
    result.push_back(list(adaptive_run<StabilisedSteps>("RKC2", cells, tolerance, end), reference));
    if (quick) break;
  }
  result.push_back(list(euler_run(cells, 0.9, end), reference));
#if !BENCH_SMOKE
  if (cells > 48) return result;  // the others take minutes there
  for (const double tolerance : {3e-2, 3e-3}) {
    result.push_back(
        list(adaptive_run<ImplicitDiffusion<>>("ARK3, implicit diffusion", cells, tolerance, end), reference));
  }
  result.push_back(list(adaptive_run<ExplicitSteps<TVDRK2>>("TVDRK2, two halves", cells, 1e-3, end), reference));
  result.push_back(list(adaptive_run<ExplicitSteps<RK4>>("RK4, two halves", cells, 1e-3, end), reference));
#endif
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Patterns on spheres against theory, and their cost");
  bool with_rates = false, with_selection = false, with_printed = false, with_cost = false, with_spectra = false;
  bool quick = BENCH_SMOKE, fourth = false;
  std::vector<std::ptrdiff_t> cells{64};
  int seeds = 10;
  double end = 2500.0, amplitude = 1e-3;
  std::string file;
  app.add_flag("--rates", with_rates, "growth rates of spherical harmonics");
  app.add_flag("--selection", with_selection, "which pattern noise grows into");
  app.add_flag("--fourth", fourth, "the same with the stencils of fourth order");
  app.add_flag("--printed", with_printed, "the same for the printed parameters on the unit sphere");
  app.add_flag("--spectra", with_spectra,
               "what spots and stripes of Koch and Meinhardt consist of, at t = 8 times --end");
  app.add_flag("--cost", with_cost, "cost of a steady pattern by different steppers");
  app.add_flag("--quick", quick, "little of everything");
  app.add_option("--cells", cells, "cells along an edge");
  app.add_option("--seeds", seeds, "number of seeds");
  app.add_option("--amplitude", amplitude, "of the harmonics of the noise that patterns start from");
  app.add_option("--end", end, "longest time of a pattern");
  app.add_option("--json", file, "write the figures to this file");
  CLI11_PARSE(app, argc, argv);
  json result;
  if (with_rates || quick) result["rates"] = rates(quick ? 32 : cells[0], quick);
  if ((with_selection && !fourth) || quick)
    result["selection"] = selection<SurfaceLaplacian<2>>(quick ? std::vector<std::ptrdiff_t>{32} : cells,
                                                         quick ? 1 : seeds, quick ? 100.0 : end, amplitude);
#if !BENCH_SMOKE
  if (fourth) result["selection"] = selection<SurfaceLaplacian<4>>(cells, seeds, end, amplitude);
#endif
  if (with_spectra) result["spectra"] = spectra(cells[0], 8.0 * end);
  if (with_printed) result["printed"] = printed(cells[0], seeds);
  if (with_cost || quick) result["cost"] = cost(quick ? 32 : cells[0], quick ? 20.0 : end, quick);
  if (!file.empty()) bench::write_json(file, result);
  return 0;
}
