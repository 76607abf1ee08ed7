// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Error against time of the ways to have a pressure that jumps across an interface: Jump, JumpMayo, ImmersedBoundary.
// A ball of tissue in free space, fed from outside: -Lap p = G (c - A) inside, [p] = -gamma kappa, and the velocity of
// its surface V = -dp/dn, all of it known. Errors are those of p at the nodes, largest and mean, and the largest one of
// V at the interface, relative to V. ImmersedBoundary spreads gamma kappa n as a force; V is that of the force less the
// gradient of p. Times are processor times of one thread for all that a new interface asks for (the level set and its
// closest points are there), and alone for what is not the Poisson solver; methods take turns, medians count.
//
//     work_precision_interface --json raw.json     then scripts/draw_work_precision_interface.py raw.json
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <support/fed_ball.hpp>
#include <vector>

#include <cambium/interface.hpp>
#include <cambium/levelset.hpp>
#include <cambium/poisson.hpp>

#include "support/clock.hpp"
#include "support/command.hpp"
#include "support/median.hpp"

using namespace cambium;

namespace bench {
namespace {

template <int D>
class Contest {
 public:
  using Case = support::FedBall<D>;

  explicit Contest(std::ptrdiff_t cells)
      : lattice_(Case::lattice(cells)),
        level_set_(lattice_, Ball<D>(Case::centre(), Case::radius)),
        poisson_(lattice_, Serial{}),
        source_(lattice_),
        f_(lattice_),
        p_(lattice_),
        velocity_(lattice_) {
    for (std::size_t i = 0; i < source_.size(); ++i) {
      if (inside(i)) source_[i] = Case::source(lattice_.position(lattice_.node(i)));
    }
  }

  void run(int rounds, nlohmann::json& table) {
    Jump<D> jump(lattice_);
    JumpMayo<D> mayo(lattice_);
    ImmersedBoundary<D> boundary(lattice_);
    InterfaceSides<D> sides(lattice_);
    Field<Vec<D>, D> force(lattice_);
    const std::vector<Entrant> entrants{
        {"Jump", [&] { correct(jump, sides); }, [&] { return error_of(sides); }},
        {"JumpMayo", [&] { correct(mayo, sides); }, [&] { return error_of(sides); }},
        {"ImmersedBoundary", [&] { spread(boundary, force); }, [&] { return error_of(boundary); }}};
    for (const Entrant& entrant : entrants) {
      entrant.solve();  // plans, kernels and buffers
      std::vector<double> all, apart;
      for (int round = 0; round < rounds; ++round) {
        const double start = cpu_seconds();
        in_solver_ = 0.0;
        entrant.solve();
        all.push_back(cpu_seconds() - start);
        apart.push_back(all.back() - in_solver_);
      }
      const auto [largest, mean] = errors_of_p();
      const double speed = entrant.error_of_speed();
      std::printf("%dD %4td %-17s p %.2e (mean %.2e)  V %.2e  %.4f s, without the solver %.4f s\n", D,
                  lattice_.nodes()[0] - 1, entrant.name, largest, mean, speed, median(all), median(apart));
      table.push_back({{"dimension", D},
                       {"cells", lattice_.nodes()[0] - 1},
                       {"method", entrant.name},
                       {"error", largest},
                       {"mean_error", mean},
                       {"error_of_speed", speed},
                       {"cpu_seconds", median(all)},
                       {"cpu_seconds_without_solver", median(apart)}});
    }
  }

 private:
  struct Entrant {
    const char* name;
    std::function<void()> solve;
    std::function<double()> error_of_speed;
  };

  bool inside(std::size_t i) const { return level_set_.band()(lattice_.node(i)) < 0.0; }
  void solve() {
    const double start = cpu_seconds();
    poisson_.solve(f_, p_);
    in_solver_ += cpu_seconds() - start;
  }
  template <class J>
  void correct(J& jump, InterfaceSides<D>& sides) {
    f_ = source_;
    jump.attach(level_set_.band(), level_set_.method().points(), Serial{});
    jump.set([](const Vec<D>&) { return -Case::surface_pressure; }, NoJump{},
             [](const Vec<D>& x) { return -Case::source(x); }, Serial{});
    jump.correct(f_, Serial{});
    solve();
    jump.at_interface(p_, sides, Serial{});
  }
  /// -Lap p = f - div F with the force F = -gamma kappa n delta, and u = F - grad p.
  void spread(ImmersedBoundary<D>& boundary, Field<Vec<D>, D>& force) {
    boundary.attach(level_set_.band(), Serial{});
    boundary.spread([](const auto& m) { return -Case::tension * m.curvature * m.normal; }, force, Serial{});
    for (std::size_t i = 0; i < f_.size(); ++i) {
      const Index<D> node = lattice_.node(i);
      f_[i] = source_[i];
      for (int d = 0; d < D; ++d) {
        if (node[d] == 0 || node[d] == lattice_.nodes()[d] - 1) continue;  // where there is no force
        const Index<D> step = Index<D>::unit(d);
        f_[i] -= (force(node + step)[d] - force(node - step)[d]) / (2.0 * lattice_.spacing());
      }
    }
    solve();
    CentredDifference<2>::gradient(p_, velocity_, Serial{});
    for (std::size_t i = 0; i < force.size(); ++i) velocity_[i] = force[i] - velocity_[i];
    boundary.interpolate(velocity_, at_markers_, Serial{});
  }

  /// Largest and mean, in the plane less a constant, which is free there.
  std::array<double, 2> errors_of_p() const {
    std::vector<double> error(p_.size());
    double shift = 0.0;
    for (std::size_t i = 0; i < p_.size(); ++i) {
      error[i] = p_[i] - Case::free_pressure(inside(i), lattice_.position(lattice_.node(i)));
      shift += error[i] / static_cast<double>(p_.size());
    }
    std::array<double, 2> result{};
    for (const double one : error) {
      const double e = std::abs(one - (D == 2 ? shift : 0.0));
      result[0] = std::max(result[0], e);
      result[1] += e / static_cast<double>(p_.size());
    }
    return result;
  }
  double error_of(const InterfaceSides<D>& sides) const {
    const auto& band = level_set_.band();
    double result = 0.0;
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      for (std::size_t i = 0; i < band.volume; ++i) {
        if (std::abs(band.values().block(b)[i]) > lattice_.spacing()) continue;
        const Vec<D> x = lattice_.position(band.values().node(b, i)) - Case::centre();
        const double speed = -dot(sides.gradient_inside.block(b)[i], x) / norm(x);
        result = std::max(result, std::abs(speed / Case::speed() - 1.0));
      }
    }
    return result;
  }
  double error_of(const ImmersedBoundary<D>& boundary) const {
    double result = 0.0;
    for (std::size_t v = 0; v < at_markers_.size(); ++v) {
      const double speed = dot(at_markers_[v], boundary.markers()[v].normal);
      result = std::max(result, std::abs(speed / Case::speed() - 1.0));
    }
    return result;
  }

  Lattice<D> lattice_;
  LevelSet<ClosestPoint, D> level_set_;
  FreeSpacePoisson<D, double, Serial> poisson_;
  Field<double, D> source_, f_, p_;
  Field<Vec<D>, D> velocity_;
  std::vector<Vec<D>> at_markers_;
  double in_solver_ = 0.0;
};

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  std::vector<std::ptrdiff_t> flat{32, 64, 128, 256, 512};
  std::vector<std::ptrdiff_t> deep{32, 64, 128};
  int rounds = 5;
  bench::Command command("Error against time of pressures that jump across an interface");
  command.app.add_option("--resolutions", flat, "cells along an axis in 2D");
  command.app.add_option("--resolutions-3d", deep, "cells along an axis in 3D");
  command.app.add_option("--rounds", rounds, "how often each is timed");
  CLI11_PARSE(command.app, argc, argv);
  if (command.quick) {
    flat = {32};
    deep = {24};
    rounds = 1;
  }
  nlohmann::json table = nlohmann::json::array();
  for (const auto cells : flat) bench::Contest<2>(cells).run(rounds, table);
  if (BENCH_SMOKE == 0) {
    for (const auto cells : deep) bench::Contest<3>(cells).run(rounds, table);
  }
  command.write({{"rounds", rounds}, {"runs", table}});
  return 0;
}
