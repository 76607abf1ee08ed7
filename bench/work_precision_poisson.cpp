// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Error against time of the ways to solve Poisson's equation in free space, for a Gaussian source off the middle of the
// unit box whose potential is known. Times are processor times of one thread in pairs: a real transform of N^D values
// there and back by FFTW, with a measured plan, in the same run. Solvers and the pair take turns; the median of the
// rounds counts. The first call, with kernels and plans, is written down as well.
//
//     work_precision_poisson --json raw.json     then scripts/draw_work_precision_poisson.py raw.json
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include <cambium/poisson.hpp>

#include "support/clock.hpp"
#include "support/command.hpp"
#include "support/median.hpp"

using namespace cambium;

namespace bench {
namespace {

template <int D>
struct Gaussian {
  static constexpr double width = 0.05;
  static Vec<D> centre() { return Vec<D>::constant(0.5) + Vec<D>::unit(0, -0.02) + Vec<D>::unit(1, 0.03); }
  static double source(const Vec<D>& x) {
    const double r = norm(x - centre()) / width;
    return std::exp(-0.5 * r * r) / std::pow(2.0 * std::numbers::pi * width * width, 0.5 * D);
  }
  static double potential(const Vec<D>& x) {
    const double pi = std::numbers::pi;
    const double r = norm(x - centre());
    if constexpr (D == 3) {
      if (r < 1e-9) return std::sqrt(2.0 / pi) / (4.0 * pi * width);
      return std::erf(r / (width * std::numbers::sqrt2)) / (4.0 * pi * r);
    } else {
      if (r < 1e-9) return (std::numbers::egamma - std::log(2.0 * width * width)) / (4.0 * pi);
      return (std::expint(-0.5 * r * r / (width * width)) - 2.0 * std::log(r)) / (4.0 * pi);
    }
  }
};

struct Entrant {
  std::string name;
  std::function<void()> solve;
  double first = 0.0;
  double error = 0.0;
  std::vector<double> seconds;
};

template <int D>
class Round {
 public:
  explicit Round(std::ptrdiff_t cells)
      : lattice_(Lattice<D>::bounded_box(Box<D>::cube(), cells)),
        f_(sample(lattice_, Gaussian<D>::source)),
        u_(lattice_) {}

  template <class Solver>
  void add(const char* name) {
    const double start = cpu_seconds();
    auto solver = std::make_shared<Solver>(lattice_);
    solver->solve(f_, u_);
    Entrant entrant{name, [this, solver] { solver->solve(f_, u_); }, cpu_seconds() - start, 0.0, {}};
    for (std::size_t i = 0; i < u_.size(); ++i) {
      const double exact = Gaussian<D>::potential(lattice_.position(lattice_.node(i)));
      entrant.error = std::max(entrant.error, std::abs(u_[i] - exact));
    }
    entrants_.push_back(std::move(entrant));
  }

  void run(int rounds, nlohmann::json& table) {
    const auto cells = lattice_.nodes()[0] - 1;
    const auto periodic = Lattice<D>::periodic_box(Box<D>::cube(), cells);
    const PeriodicTransform<D> transform(periodic, Planning::measure);
    Field<double, D> x(periodic);
    AlignedVector<std::complex<double>> z(transform.size());
    std::vector<double> pairs;
    for (int round = 0; round < rounds; ++round) {
      pairs.push_back(time([&] {
        transform.forward(x.data(), z.data());
        transform.backward(z.data(), x.data());
      }));
      for (auto& entrant : entrants_) entrant.seconds.push_back(time(entrant.solve));
    }
    const double pair = median(pairs);
    for (const auto& entrant : entrants_) {
      const double seconds = median(entrant.seconds);
      std::printf("%dD %5td %-28s error %.2e  %6.2f pairs  first call %.3f s\n", D, cells, entrant.name.c_str(),
                  entrant.error, seconds / pair, entrant.first);
      table.push_back({{"dimension", D},
                       {"cells", cells},
                       {"method", entrant.name},
                       {"error", entrant.error},
                       {"cpu_seconds", seconds},
                       {"pairs", seconds / pair},
                       {"first_call_seconds", entrant.first},
                       {"pair_seconds", pair}});
    }
  }

 private:
  template <class F>
  static double time(F&& f) {
    const double start = cpu_seconds();
    f();
    return cpu_seconds() - start;
  }

  Lattice<D> lattice_;
  Field<double, D> f_;
  Field<double, D> u_;
  std::vector<Entrant> entrants_;
};

template <int D>
void run(const std::vector<std::ptrdiff_t>& resolutions, int rounds, nlohmann::json& table) {
  for (const std::ptrdiff_t cells : resolutions) {
    Round<D> round(cells);
    if constexpr (D == 3) round.template add<FreeSpacePoisson<3, double, Serial>>("lattice, boundary values");
    round.template add<FreeSpaceConvolution<D, LatticeKernel, double, Serial>>("lattice, convolution");
    round.template add<FreeSpaceConvolution<D, PointKernel, double, Serial>>("points");
    round.template add<FreeSpaceConvolution<D, SpectralKernel, double, Serial>>("spectral");
    round.run(rounds, table);
  }
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  std::vector<std::ptrdiff_t> flat{32, 64, 128, 256, 512};
  std::vector<std::ptrdiff_t> deep{16, 32, 64, 128};
  int rounds = 9;
  bench::Command command("Error against time of Poisson's equation in free space");
  command.app.add_option("--resolutions", flat, "cells along an axis in 2D");
  command.app.add_option("--resolutions-3d", deep, "cells along an axis in 3D");
  command.app.add_option("--rounds", rounds, "how often each is timed");
  CLI11_PARSE(command.app, argc, argv);
  if (command.quick) {
    flat = {16, 32};
    deep = {16};
    rounds = 1;
  }
  nlohmann::json table = nlohmann::json::array();
  bench::run<2>(flat, rounds, table);
  if (BENCH_SMOKE == 0 || command.quick) bench::run<3>(deep, rounds, table);
  command.write({{"rounds", rounds}, {"runs", table}});
  return 0;
}
