// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where ways to grow a tumour fail, in the plane, beside the defaults on the same scenes.
//   ellipse     (11.72), e = 0.1, r = 2, gamma = 0.05, t = 1.6, with other reinitialisations
//   filter      the same, gamma = 0 and 0.5, with filters of the speed and without: does the answer depend on them?
//   pair        two discs that meet: free space keeps them apart, no pressure outside lets them join
//   wall        a disc that reaches the box; extinct: one that dies out
//   ring        healthy tissue that a ring of tumour encloses
//   right-hand side  p = 0 outside by GMRES on the right-hand side, and by Dirichlet: slope, time
// Numbers: area; imbalance, area over what the sources have added, minus 1; length of the interface; parts; and the
// error that ended a run before its time, after which the tumour is as it was before the step.
//
//     failure_map_tumour --json docs/charts/failure_map_tumour.json
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <cambium/interface/jump_mayo.hpp>
#include <cambium/interface/right_hand_side_gmres.hpp>
#include <cambium/levelset.hpp>
#include <cambium/models/tumour.hpp>
#include <cambium/poisson.hpp>

#include "support/clock.hpp"
#include "support/command.hpp"
#include "support/fed_ball.hpp"

using namespace cambium;

namespace {

using Json = nlohmann::json;

Lattice<2> box(std::ptrdiff_t cells) {
  return Lattice<2>::bounded_box({Vec<2>::constant(-6.0), Vec<2>::constant(6.0)}, cells);
}
double ellipse(const Vec<2>& x) { return std::hypot(1.1 * (x[0] - 0.02), 0.9 * (x[1] - 0.03)) - 2.0; }
[[maybe_unused]] double pair(const Vec<2>& x) {
  return std::min(norm(x - Vec<2>{1.6, 0.0}), norm(x + Vec<2>{1.6, 0.0})) - 1.3;
}
[[maybe_unused]] double ring(const Vec<2>& x) { return std::abs(norm(x - Vec<2>{0.02, 0.03}) - 2.0) - 0.8; }
double disc(const Vec<2>& x, double radius) { return norm(x - Vec<2>{0.02, 0.03}) - radius; }

/// What the sources add to the area in a unit of time: G (1 - A) times the area, and what differs from that inside.
template <class T>
double gain(const T& tumour, double area) {
  const auto& p = tumour.parameters();
  double sum = p.growth * (1.0 - p.apoptosis) * area;
  detail::for_each_side(tumour.level_set().band(), Serial{}, [&](std::size_t i, bool inside) {
    if (inside) sum += p.growth * (tumour.nutrient()[i] - 1.0) * tumour.lattice().cell_volume();
  });
  return sum;
}

/// Grows a tumour to a time, or until it ends.
template <class T, class Shape>
Json grow(const char* scene, const char* method, const Lattice<2>& lattice, Shape&& shape, double end,
          const TumourParameters& parameters) {
  Json row{{"scene", scene}, {"method", method}, {"cells", lattice.nodes()[0] - 1}, {"gamma", parameters.tension}};
  double expected = 0.0, rate = 0.0;
  int steps = 0;
  try {
    T tumour(lattice, shape, {.parameters = parameters});
    const auto look = [&](double dt) {
      const auto found = measures(tumour.level_set().band());
      const double now = gain(tumour, found.volume);
      expected = dt > 0.0 ? expected + 0.5 * dt * (rate + now) : found.volume;
      rate = now;
      row["t"] = tumour.time();
      row["area"] = found.volume;
      row["length"] = found.area;
      row["imbalance"] = found.volume / expected - 1.0;
      row["parts"] = found.inside_components;
      row["interfaces"] = found.interface_components;
    };
    look(0.0);
    for (; end - tumour.time() > 1e-12 && !tumour.extinct() && steps < 3000; ++steps) {
      look(tumour.step(end - tumour.time()).dt);
    }
    row["ended"] = tumour.extinct() ? "extinct" : steps < 3000 ? "at its time" : "3000 steps";
  } catch (const Error& error) {
    row["ended"] = error.what();
  }
  row["steps"] = steps;
  std::printf("| %s | %s | %g | %.3f | %.3f | %.2f%% | %.2f | %zu | %zu | %d | %.60s |\n", scene, method,
              parameters.tension, row.value("t", 0.0), row.value("area", 0.0), 100.0 * row.value("imbalance", 0.0),
              row.value("length", 0.0), row.value("parts", std::size_t{0}), row.value("interfaces", std::size_t{0}),
              steps, row["ended"].get<std::string>().c_str());
  std::fflush(stdout);
  return row;
}

#if !BENCH_SMOKE
/// V of a fed disc with p = 0 outside, largest relative error at the interface, by both ways.
struct FedDisc {
  using Case = support::FedBall<2>;
  Lattice<2> lattice;
  LevelSet<ClosestPoint, 2> level_set{lattice, Ball<2>(Case::centre(), Case::radius)};
  Field<double, 2> f{lattice}, p{lattice};

  explicit FedDisc(std::ptrdiff_t cells) : lattice(Case::lattice(cells)) {
    for (std::size_t i = 0; i < f.size(); ++i) {
      if (level_set.band()(lattice.node(i)) < 0.0) f[i] = Case::source(lattice.position(lattice.node(i)));
    }
  }
  template <class Speed>
  Json row(const char* method, int iterations, double seconds, Speed&& speed) const {
    const auto& band = level_set.band();
    double error = 0.0;
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      for (std::size_t i = 0; i < band.volume; ++i) {
        if (std::abs(band.values().block(b)[i]) > lattice.spacing()) continue;
        error = std::max(error, std::abs(speed(b, i) / Case::speed() - 1.0));
      }
    }
    const std::ptrdiff_t cells = lattice.nodes()[0] - 1;
    std::printf("V with p = 0 outside, %s, %td cells: off by %.1e, %d iterations, %.3f s\n", method, cells, error,
                iterations, seconds);
    return {{"scene", "right-hand side"}, {"method", method},         {"cells", cells},
            {"speed_error", error},       {"iterations", iterations}, {"seconds", seconds}};
  }
  Json by_dirichlet() {
    const double start = bench::cpu_seconds();
    Dirichlet<2> inside(level_set.band(), {}, OpenMP{1});
    Field<double, 2, Sparse> slope(lattice);
    const auto report = inside.solve(
        f, [](const Vec<2>&) { return Case::surface_pressure; }, p);
    inside.normal_derivative(level_set.band(), level_set.method().points(), p, slope);
    return row("Dirichlet", report.iterations, bench::cpu_seconds() - start,
               [&](std::size_t b, std::size_t i) { return -slope.block(b)[i]; });
  }
  Json by_right_hand_side() {
    const double start = bench::cpu_seconds();
    JumpMayo<2> jump(lattice);
    jump.attach(level_set.band(), level_set.method().points());
    jump.set([](const Vec<2>&) { return -Case::surface_pressure; }, NoJump{},
             [](const Vec<2>& x) { return -Case::source(x); });
    jump.correct(f);
    FreeSpacePoisson<2, double, OpenMP> poisson(lattice, OpenMP{1});
    RightHandSideGmres<2> outside(lattice);
    outside.attach(level_set.band());
    const auto report = outside.solve(poisson, f, p);
    InterfaceSides<2> sides(lattice);
    jump.at_interface(p, sides);
    const double seconds = bench::cpu_seconds() - start;
    return row("RightHandSideGmres", report.iterations, seconds, [&](std::size_t b, std::size_t i) {
      const Vec<2> x = lattice.position(level_set.band().values().node(b, i)) - Case::centre();
      return -dot(sides.gradient_inside.block(b)[i], x / norm(x));
    });
  }
};
#endif

void run(bool quick, Json& rows) {
  const std::ptrdiff_t n = quick ? 48 : 64;
  const double end = quick ? 0.05 : 1.6;
  const TumourParameters soft{.tension = 0.05};
  [[maybe_unused]] const TumourParameters firm{.tension = 0.5}, softer{.tension = 0.1}, none{.tension = 0.0};
  const auto add = [&](Json row) { rows.push_back(std::move(row)); };
  add(grow<Tumour<2, SemiImplicit>>("ellipse", "ClosestPoint", box(n), ellipse, end, soft));
  add(grow<Tumour<2, SemiImplicit>>("wall", "FreeSpace", box(n), [](const Vec<2>& x) { return disc(x, 4.6); },
                                    quick ? 0.2 : 1.0, {.apoptosis = 0.1, .tension = 0.1}));
#if !BENCH_SMOKE
  add(grow<Tumour<2, SemiImplicit, ReinitialiseBy<GroupMarching<>>>>("ellipse", "GroupMarching", box(n), ellipse, end,
                                                                     soft));
  add(grow<Tumour<2, SemiImplicit, ReinitialiseBy<PdeReinit<>>>>("ellipse", "PdeReinit", box(n), ellipse, end, soft));
  const Lattice<2> wide = Lattice<2>::bounded_box({Vec<2>::constant(-9.0), Vec<2>::constant(9.0)}, 3 * n / 2);
  const Lattice<2> finer = Lattice<2>::bounded_box(wide.box(), 3 * n);
  for (const Lattice<2>& lattice : {wide, finer}) {
    add(grow<Tumour<2, SemiImplicit>>("late", "ClosestPoint", lattice, ellipse, 3.0, firm));
    add(grow<Tumour<2, SemiImplicit, ReinitialiseBy<GroupMarching<>>>>("late", "GroupMarching", lattice, ellipse, 3.0,
                                                                       firm));
    add(grow<Tumour<2, SemiImplicit, ReinitialiseBy<PdeReinit<>>>>("late", "PdeReinit", lattice, ellipse, 3.0, firm));
  }
  for (const std::ptrdiff_t cells : {n, 2 * n}) {
    for (const auto& p : {none, firm}) {
      add(grow<Tumour<2, SemiImplicit>>("filter", "none", box(cells), ellipse, end, p));
      add(grow<Tumour<2, SemiImplicit, GaussianFilter<1>>>("filter", "Gaussian<1>", box(cells), ellipse, end, p));
      add(grow<Tumour<2, SemiImplicit, GaussianFilter<2>>>("filter", "Gaussian<2>", box(cells), ellipse, end, p));
    }
  }
  add(grow<Tumour<2, SemiImplicit>>("pair", "FreeSpace", box(n), pair, 0.5, softer));
  add(grow<Tumour<2, SemiImplicit, ZeroOutside>>("pair", "ZeroOutside", box(n), pair, 0.5, softer));
  add(grow<Tumour<2, SemiImplicit>>("ring", "FreeSpace", box(n), ring, 0.5, softer));
  add(grow<Tumour<2, SemiImplicit, ZeroOutside>>("ring", "ZeroOutside", box(n), ring, 0.5, softer));
  add(grow<Tumour<2, SemiImplicit>>("extinct", "FreeSpace", box(n), [](const Vec<2>& x) { return disc(x, 1.0); }, 4.0,
                                    {.apoptosis = 1.5, .tension = 0.1}));
  for (const std::ptrdiff_t cells : {32, 64, 128}) {
    add(FedDisc(cells).by_dirichlet());
    add(FedDisc(cells).by_right_hand_side());
  }
#endif
}

}  // namespace

int main(int argc, char** argv) {
  bench::Command command("Where ways to grow a tumour fail");
  CLI11_PARSE(command.app, argc, argv);
  Json rows = Json::array();
  std::printf("| scene | method | gamma | t | area | imbalance | length | parts | interfaces | steps | ended |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|\n");
  run(command.quick, rows);
  command.write(Json{{"runs", rows}});
  return 0;
}
