// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Error against time of particles that are remeshed in every step, for every kernel and strategy. A bell is wound up by
// a flow and, from half time on, unwound again: the single vortex in 2D (LeVeque 1996), T = 8, and the deformation of
// LeVeque and Enright in 3D, T = 3. Errors are taken at half time, against points traced back along the flow, and at
// the end, against the bell. Particles that are never remeshed are all home again at the end, whatever happened to the
// field in between: for them only the error at half time means something.
//
// The step is bound by the Lagrangian CFL number alone and so the same for all resolutions; its error is that of
// particles that are never remeshed at the end, and written down with the others. Times are processor times of one
// thread, those of tracing points and of measuring errors not among them.
//
//     work_precision_remeshing --json raw.json     then scripts/draw_work_precision_remeshing.py raw.json
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include <cambium/interpolation.hpp>
#include <cambium/kernels.hpp>
#include <cambium/time.hpp>

#include "support/clock.hpp"
#include "support/command.hpp"

using namespace cambium;

namespace bench {
namespace {

constexpr double pi = std::numbers::pi;

/// sin^2(pi x) and sin(2 pi x).
struct Waves {
  double squared;
  double twice;
  explicit Waves(double x) {
    const double s = std::sin(pi * x);
    squared = s * s;
    twice = 2.0 * s * std::cos(pi * x);
  }
};

/// A flow that turns back at half time, and the bell (1 - r^2 / radius^2)^6 that it carries.
template <int D>
struct Scene;

/// Stream function cos(pi t / T) sin^2(pi x) sin^2(pi y) / pi.
template <>
struct Scene<2> {
  static constexpr const char* name = "swirl";
  static constexpr double period = 8.0;
  static constexpr double largest_gradient = 2.0 * pi;
  static constexpr Vec<2> centre{0.5, 0.75};
  static constexpr double radius = 0.25;

  static Vec<2> velocity(const Vec<2>& x, double t) {
    const Waves a(x[0]), b(x[1]);
    return Vec<2>{a.squared * b.twice, -b.squared * a.twice} * std::cos(pi * t / period);
  }
};

/// u = 2 sin^2(pi x) sin(2 pi y) sin(2 pi z), v and w alike with the sign turned and without the 2.
template <>
struct Scene<3> {
  static constexpr const char* name = "deformation";
  static constexpr double period = 3.0;
  static constexpr double largest_gradient = 4.0 * pi;
  static constexpr Vec<3> centre{0.35, 0.35, 0.35};
  static constexpr double radius = 0.3;

  static Vec<3> velocity(const Vec<3>& x, double t) {
    const Waves a(x[0]), b(x[1]), c(x[2]);
    return Vec<3>{2.0 * a.squared * b.twice * c.twice, -b.squared * a.twice * c.twice, -c.squared * a.twice * b.twice} *
           std::cos(pi * t / period);
  }
};

template <int D>
double bell(const Vec<D>& x) {
  const Vec<D> r = (x - Scene<D>::centre) / Scene<D>::radius;
  const double inside = 1.0 - dot(r, r);
  return inside > 0.0 ? std::pow(inside, 6) : 0.0;
}

struct Errors {
  double l2 = 0.0;    ///< root mean square, relative to that of the exact values
  double linf = 0.0;  ///< largest, the bell being 1 high
};

template <int D>
Errors errors_of(const Field<double, D>& values, const Field<double, D>& exact) {
  Errors errors;
  double size = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double difference = values[i] - exact[i];
    errors.l2 += difference * difference;
    errors.linf = std::max(errors.linf, std::abs(difference));
    size += exact[i] * exact[i];
  }
  errors.l2 = std::sqrt(errors.l2 / size);
  return errors;
}

/// One step of particles along the flow.
template <int D>
class Flow {
 public:
  void step(Columns<D, double> positions, double t, double dt) {
    stepper_.step(positions, t, dt, [](auto x, double time, auto u) {
      for (std::size_t p = 0; p < x.size(); ++p) u.set(p, Scene<D>::velocity(x[p], time));
    });
  }

 private:
  RK4<Columns<D, double>, Serial> stepper_{Serial{}};
};

template <int D>
Particles<D> at_nodes(const Lattice<D>& lattice) {
  Particles<D> particles(lattice.size());
  for (std::size_t i = 0; i < lattice.size(); ++i) particles.positions().set(i, lattice.position(lattice.node(i)));
  return particles;
}

/// What all runs at one resolution are held against.
template <int D>
struct Reference {
  Lattice<D> lattice;
  int steps;  ///< to the end, an even number
  Field<double, D> start;
  Field<double, D> half;

  Reference(std::ptrdiff_t cells, double courant)
      : lattice(Lattice<D>::periodic_box(Box<D>::cube(), cells)),
        steps(2 * static_cast<int>(
                      std::ceil(Scene<D>::period / 2.0 / strain_limit(courant, Scene<D>::largest_gradient).dt))),
        start(sample(lattice, bell<D>)),
        half(lattice) {
    half = traced_back(2 * steps);
  }

  /// Values at the nodes at half time: those of the points the nodes came from, traced back in steps of T / `count`.
  Field<double, D> traced_back(int count) const {
    Particles<D> points = at_nodes(lattice);
    Flow<D> flow;
    const double dt = Scene<D>::period / count;
    // T/2 + s stands for T/2 - s: cos(pi t / T) is odd about T/2.
    for (int n = 0; n < count / 2; ++n) flow.step(points.positions(), Scene<D>::period / 2.0 + n * dt, dt);
    Field<double, D> values(lattice);
    for (std::size_t i = 0; i < lattice.size(); ++i) values[i] = bell<D>(points.positions()[i]);
    return values;
  }
  /// What is left of the error at half time when the lattice is as fine as can be: that of the steps.
  double error_of_steps() const { return errors_of(traced_back(steps), half).l2; }
};

struct Result {
  Errors half;
  Errors end;
  double seconds = 0.0;         ///< processor time of moving and remeshing
  double remesh_seconds = 0.0;  ///< of remeshing alone
  double mean_particles = 0.0;  ///< over all steps
};

/// How particles are replaced after a step; the threshold is relative to the height of the bell.
template <class Kernel, class Strategy, int D>
class Remeshed {
 public:
  explicit Remeshed(const Lattice<D>& lattice, double threshold)
      : lattice_(lattice), remesh_({.threshold = threshold * lattice.cell_volume()}, Serial{}) {}
  void operator()(Particles<D>& particles, Attribute<double> strength) { remesh_(particles, lattice_, strength); }

 private:
  Lattice<D> lattice_;
  Remesher<Kernel, Strategy, Serial> remesh_;
};

struct Never {
  template <int D>
  void operator()(Particles<D>&, Attribute<double>) const {}
};

/// Follows the bell to the end and takes errors on the way, with strengths given to the lattice by Kernel.
template <class Kernel, int D, class Remesh>
Result run(const Reference<D>& reference, Remesh&& remesh) {
  const Lattice<D>& lattice = reference.lattice;
  const double volume = lattice.cell_volume();
  Particles<D> particles = at_nodes(lattice);
  const auto strength = particles.template add<double>("strength");
  for (std::size_t i = 0; i < lattice.size(); ++i) particles[strength][i] = reference.start[i] * volume;
  const auto errors = [&](const Field<double, D>& exact) {
    Field<double, D> values(lattice);
    p2m<Kernel>(particles, strength, values, Serial{});
    for (double& value : values.values()) value /= volume;
    return errors_of(values, exact);
  };
  Result result;
  Flow<D> flow;
  const double dt = Scene<D>::period / reference.steps;
  for (int n = 0; n < reference.steps; ++n) {
    result.mean_particles += static_cast<double>(particles.size()) / reference.steps;
    const double start = cpu_seconds();
    flow.step(particles.positions(), n * dt, dt);
    const double moved = cpu_seconds();
    remesh(particles, strength);
    const double end = cpu_seconds();
    result.seconds += end - start;
    result.remesh_seconds += end - moved;
    if (2 * (n + 1) == reference.steps) result.half = errors(reference.half);
  }
  result.end = errors(reference.start);
  return result;
}

/// Largest relative error of the density that particles of equal strength a distance (1 + stretch) h apart give to
/// nodes a distance h apart, with any offset: what one remeshing does to a constant field after a step that has
/// stretched it.
template <class Kernel>
double error_of_stretch(double stretch) {
  constexpr int offsets = 256;
  double largest = 0.0;
  for (int k = 0; k < offsets; ++k) {
    double sum = 0.0;
    for (int j = -Kernel::support; j <= Kernel::support; ++j) {
      sum += static_cast<double>(Kernel::value((1.0 + stretch) * (static_cast<double>(k) / offsets + j)));
    }
    largest = std::max(largest, std::abs(sum * (1.0 + stretch) - 1.0));
  }
  return largest;
}

/// Runs the scene in D dimensions and collects the results.
template <int D>
class Study {
 public:
  /// \param refine  steps become shorter as the spacing does; `courant` is that of the coarsest lattice
  Study(const std::vector<std::ptrdiff_t>& resolutions, double courant, bool refine, nlohmann::json& table)
      : table_(table) {
    for (const std::ptrdiff_t cells : resolutions) {
      const double finer = static_cast<double>(cells) / static_cast<double>(resolutions.front());
      references_.emplace_back(cells, refine ? courant / finer : courant);
    }
    if (references_.empty()) return;
    error_of_steps_ = references_.front().error_of_steps();
    std::printf("\n%s in %dD, RK4, Lagrangian CFL number %g: %d steps, whose own error at T/2 is %.1e\n",
                Scene<D>::name, D, courant, references_.front().steps, error_of_steps_);
    std::printf("%-14s %-10s %5s %10s %6s %10s %6s %9s %9s\n", "kernel", "strategy", "cells", "L2 at T/2", "order",
                "L2 at T", "order", "CPU s", "remesh s");
  }

  template <class Kernel>
  void kernel(const char* name) {
    nlohmann::json row{{"scene", "stretch"}, {"kernel", name}};
    for (const double stretch : {0.2, 0.1, 0.05}) row["errors"].push_back(error_of_stretch<Kernel>(stretch));
    if (D == 2) table_.push_back(row);
    series(name, "tensor", [](const auto& r) { return run<Kernel>(r, Remeshed<Kernel, Tensor, D>(r.lattice, 0.0)); });
    series(name, "threshold",
           [](const auto& r) { return run<Kernel>(r, Remeshed<Kernel, Tensor, D>(r.lattice, 1e-10)); });
    series(name, "split", [](const auto& r) { return run<Kernel>(r, Remeshed<Kernel, Split, D>(r.lattice, 0.0)); });
  }
  void never() {
    series("none", "never", [](const auto& r) { return run<M6>(r, Never{}); });
  }

 private:
  template <class Run>
  void series(const char* kernel, const char* strategy, Run&& run) {
    Result before;
    std::ptrdiff_t cells_before = 0;
    for (const Reference<D>& reference : references_) {
      const Result result = run(reference);
      const std::ptrdiff_t cells = reference.lattice.nodes()[0];
      nlohmann::json row{{"scene", Scene<D>::name},
                         {"dimension", D},
                         {"kernel", kernel},
                         {"strategy", strategy},
                         {"cells", cells},
                         {"steps", reference.steps},
                         {"error_of_steps", error_of_steps_},
                         {"mean_particles", result.mean_particles},
                         {"half", {{"l2", result.half.l2}, {"linf", result.half.linf}}},
                         {"end", {{"l2", result.end.l2}, {"linf", result.end.linf}}},
                         {"cpu_seconds", result.seconds},
                         {"remesh_cpu_seconds", result.remesh_seconds}};
      double half_order = 0.0;
      double end_order = 0.0;
      if (cells_before > 0) {
        const double refinement = std::log(static_cast<double>(cells) / static_cast<double>(cells_before));
        row["half"]["order"] = half_order = std::log(before.half.l2 / result.half.l2) / refinement;
        row["end"]["order"] = end_order = std::log(before.end.l2 / result.end.l2) / refinement;
      }
      std::printf("%-14s %-10s %5td %10.2e %6.2f %10.2e %6.2f %9.3f %9.3f\n", kernel, strategy, cells, result.half.l2,
                  half_order, result.end.l2, end_order, result.seconds, result.remesh_seconds);
      std::fflush(stdout);
      table_.push_back(row);
      before = result;
      cells_before = cells;
    }
  }

  nlohmann::json& table_;
  std::vector<Reference<D>> references_;
  double error_of_steps_ = 0.0;
};

/// `smoke`: one kernel, so that a test of the program compiles in seconds.
template <bool smoke, int D>
void run_kernels(Study<D>& study) {
  study.never();
  study.template kernel<M4Prime>("M4Prime");
  if constexpr (!smoke && D == 2) {
    study.template kernel<Hat>("Hat");
    study.template kernel<M3>("M3");
    study.template kernel<M4>("M4");
    study.template kernel<Lambda<2, 2>>("Lambda22");
    study.template kernel<M6TriplePrime>("M6TriplePrime");
    study.template kernel<Lambda<8, 4>>("Lambda84");
  }
  if constexpr (!smoke) {
    study.template kernel<M6>("M6");
    study.template kernel<Lambda<4, 4>>("Lambda44");
    study.template kernel<Lambda<6, 4>>("Lambda64");
  }
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  std::vector<std::ptrdiff_t> flat{64, 128, 256};
  std::vector<std::ptrdiff_t> deep{32, 64};
  double courant = 0.25;
  bool quick = false;
  bool refine = false;
  std::string json;
  CLI::App app("Error against time of remeshing, for every kernel and strategy");
  app.add_option("--resolutions", flat, "cells along an axis in 2D, coarse to fine (0: leave 2D out)");
  app.add_option("--resolutions-3d", deep, "cells along an axis in 3D, coarse to fine (0: leave 3D out)");
  app.add_option("--courant", courant, "Lagrangian CFL number: step times largest velocity gradient");
  app.add_flag("--refine-steps", refine,
               "let the step fall with the spacing; the CFL number is the coarsest lattice's");
  app.add_option("--json", json, "write the results to this file");
  app.add_flag("--quick", quick, "coarse lattices and long steps, to see that it runs");
  CLI11_PARSE(app, argc, argv);
  if (quick) {
    flat = {16, 32};
    deep = {16};
    courant = 0.5;
  }
  std::erase(flat, 0);
  std::erase(deep, 0);

  nlohmann::json table = nlohmann::json::array();
  bench::Study<2> swirl(flat, courant, refine, table);
  if (!flat.empty()) bench::run_kernels<BENCH_SMOKE != 0>(swirl);
  bench::Study<3> deformation(deep, courant, refine, table);
  if (!deep.empty()) bench::run_kernels<BENCH_SMOKE != 0>(deformation);
  if (!json.empty()) {
    bench::write_json(json, {{"courant", courant}, {"refine_steps", refine}, {"stepper", "RK4"}, {"runs", table}});
  }
  return 0;
}
