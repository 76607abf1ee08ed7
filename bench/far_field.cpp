// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The potential that sources at the nodes of a box make at the nodes of its faces, in space: by a tree, by the plain
// sum, and as a by-product of the solvers on the lattice, which give it at all nodes. Sources fill the box, or a ball a
// tenth as wide as the box; the solvers do not care. Errors are the largest, against the plain sum (at some of the
// targets), over the potential of the absolute strengths; processor times of one thread, medians of rounds in turns. A
// tree is given its sources anew each time; solvers keep kernels and plans, whose making is written down as well.
//
//     far_field --json raw.json     then scripts/draw_far_field.py raw.json
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include <cambium/farfield.hpp>
#include <cambium/poisson.hpp>

#include "support/clock.hpp"
#include "support/command.hpp"
#include "support/median.hpp"

using namespace cambium;

namespace bench {
namespace {

struct Points {
  std::array<std::vector<double>, 3> x;
  void add(const Vec<3>& at) {
    for (int d = 0; d < 3; ++d) x[static_cast<std::size_t>(d)].push_back(at[d]);
  }
  std::size_t size() const { return x[0].size(); }
  Columns<3, const double> view(std::size_t count) const { return {{x[0].data(), x[1].data(), x[2].data()}, count}; }
  Columns<3, const double> view() const { return view(size()); }
};

struct Entrant {
  std::string name;
  std::function<void()> run;
  double tolerance = 0.0;
  double first = 0.0;
  double error = 0.0;
  std::vector<double> seconds;
};

double time(const std::function<void()>& f) {
  const double start = cpu_seconds();
  f();
  return cpu_seconds() - start;
}

class Scene {
 public:
  Scene(std::ptrdiff_t cells, const std::string& sources)
      : name_(sources), lattice_(Lattice<3>::bounded_box(Box<3>::cube(), cells)), f_(lattice_), u_(lattice_) {
    std::mt19937 random(1);
    std::uniform_real_distribution<> strength(0.0, 1.0);
    const double volume = std::pow(lattice_.spacing(), 3);
    for (std::size_t i = 0; i < lattice_.size(); ++i) {
      const Index<3> node = lattice_.node(i);
      const Vec<3> x = lattice_.position(node);
      bool face = false;
      for (int d = 0; d < 3; ++d) face = face || node[d] == 0 || node[d] == cells;
      if (face) {
        targets_.add(x);
        target_nodes_.push_back(i);
      } else if (sources != "ball" || norm(x - Vec<3>::constant(0.5)) < 0.05) {
        sources_.add(x);
        q_.push_back(strength(random));
        f_[i] = q_.back() / volume;
      }
    }
    shuffle_targets(random);
    const std::size_t some = std::min<std::size_t>(targets_.size(), 512);
    exact_.resize(some);
    unit_.resize(some);
    const double start = cpu_seconds();
    direct_potential<3>(sources_.view(), q_, targets_.view(some), exact_, Serial{});
    direct_seconds_ = (cpu_seconds() - start) * static_cast<double>(targets_.size()) / static_cast<double>(some);
    unit_ = exact_;  // strengths are positive
    found_.resize(targets_.size());
  }

  void add_tree(double tolerance) {
    auto tree = std::make_shared<TreePotential<3, Serial>>(TreePotential<3, Serial>::Params{tolerance}, Serial{});
    add("tree", tolerance, [this, tree] {
      tree->set_sources(sources_.view(), q_);
      tree->evaluate(targets_.view(), found_);
    });
  }
  template <class Solver>
  void add_solver(const char* name) {
    const double start = cpu_seconds();
    auto solver = std::make_shared<Solver>(lattice_);
    const double first = cpu_seconds() - start;
    add(name, 0.0, [this, solver] {
      solver->solve(f_, u_);
      for (std::size_t t = 0; t < found_.size(); ++t) found_[t] = u_[target_nodes_[t]];
    });
    entrants_.back().first = first;
  }

  void run(int rounds, nlohmann::json& table) {
    for (int round = 0; round < rounds; ++round) {
      for (auto& entrant : entrants_) entrant.seconds.push_back(time(entrant.run));
    }
    Entrant plain{"plain sum", {}, 0.0, 0.0, 1e-16, {direct_seconds_}};
    entrants_.push_back(plain);
    for (const auto& entrant : entrants_) {
      const double seconds = median(entrant.seconds);
      std::printf("%4td %-5s sources %8zu targets %7zu %-26s %.0e error %.1e  %.4f s\n", lattice_.nodes()[0] - 1,
                  name_.c_str(), sources_.size(), targets_.size(), entrant.name.c_str(), entrant.tolerance,
                  entrant.error, seconds);
      table.push_back({{"cells", lattice_.nodes()[0] - 1},
                       {"sources", name_},
                       {"source_count", sources_.size()},
                       {"target_count", targets_.size()},
                       {"method", entrant.name},
                       {"tolerance", entrant.tolerance},
                       {"error", entrant.error},
                       {"cpu_seconds", seconds},
                       {"setup_seconds", entrant.first}});
    }
  }

 private:
  void shuffle_targets(std::mt19937& random) {
    for (std::size_t t = targets_.size(); t-- > 1;) {
      const std::size_t other = random() % (t + 1);
      for (auto& x : targets_.x) std::swap(x[t], x[other]);
      std::swap(target_nodes_[t], target_nodes_[other]);
    }
  }
  void add(const char* name, double tolerance, std::function<void()> run) {
    run();
    Entrant entrant{name, std::move(run), tolerance, 0.0, 0.0, {}};
    for (std::size_t t = 0; t < exact_.size(); ++t) {
      entrant.error = std::max(entrant.error, std::abs(found_[t] - exact_[t]) / unit_[t]);
    }
    entrants_.push_back(std::move(entrant));
  }

  std::string name_;
  Lattice<3> lattice_;
  Field<double, 3> f_, u_;
  Points sources_, targets_;
  std::vector<std::size_t> target_nodes_;
  std::vector<double> q_, exact_, unit_, found_;
  double direct_seconds_ = 0.0;
  std::vector<Entrant> entrants_;
};

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  std::vector<std::ptrdiff_t> resolutions{16, 32, 64};
  std::vector<double> tolerances{1e-1, 1e-3, 1e-6, 1e-9};
  int rounds = 3;
  bench::Command command("Potentials of sources in a box at its faces: a tree against solvers on the lattice");
  command.app.add_option("--resolutions", resolutions, "cells along an axis");
  command.app.add_option("--tolerances", tolerances, "of the tree");
  command.app.add_option("--rounds", rounds, "how often each is timed");
  CLI11_PARSE(command.app, argc, argv);
  if (command.quick) {
    resolutions = {12};
    tolerances = {1e-3};
    rounds = 1;
  }
  nlohmann::json table = nlohmann::json::array();
  for (const std::ptrdiff_t cells : resolutions) {
    for (const char* sources : {"box", "ball"}) {
      bench::Scene scene(cells, sources);
      for (const double tolerance : tolerances) scene.add_tree(tolerance);
      scene.add_solver<FreeSpaceConvolution<3, PointKernel, double, Serial>>("points, convolution");
      if (BENCH_SMOKE == 0) {
        scene.add_solver<FreeSpacePoisson<3, double, Serial>>("lattice, boundary values");
        scene.add_solver<FreeSpaceDirichlet<3, PointKernel, double, Serial>>("points, then Dirichlet");
      }
      scene.run(rounds, table);
    }
  }
  command.write({{"rounds", rounds}, {"runs", table}});
  return 0;
}
