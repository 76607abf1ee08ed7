// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Speed of P2M, M2P and remeshing beside plain loops, beside the multiply-adds a core can do at most, and beside what
// arithmetic gains from a second thread. What is compared takes turns (support/contest.hpp). Work on one thread is
// measured in processor time, work on two on the wall.
//
//     interpolation --benchmark_out=raw.json     then scripts/summarise_interpolation.py raw.json
#include <CLI/CLI.hpp>
#include <benchmark/benchmark.h>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <cambium/interpolation.hpp>
#include <cambium/kernels.hpp>

#include "plain/loop.hpp"
#include "support/clock.hpp"
#include "support/contest.hpp"
#include "support/peak.hpp"
#include "support/scene.hpp"
#include "support/user_loop.hpp"

using namespace cambium;

namespace bench {
namespace {

struct Options {
  std::size_t rounds = 9;
  std::ptrdiff_t cells_2d = 1024;
  std::ptrdiff_t cells_3d = 128;
  std::vector<std::ptrdiff_t> error_cells{32, 64, 128};
  std::size_t peak_steps = 2'000'000;

  template <int D>
  std::ptrdiff_t cells() const {
    return D == 2 ? cells_2d : cells_3d;
  }
};

enum class Way { p2m, m2p };
constexpr const char* name(Way way) { return way == Way::p2m ? "p2m" : "m2p"; }

template <class T>
constexpr const char* scalar_name = sizeof(T) == 4 ? "float" : "double";

/// Nodes that a particle gives to or takes from.
template <class K, int D>
constexpr double nodes_per_particle() {
  double nodes = 1.0;
  for (int d = 0; d < D; ++d) nodes *= K::support;
  return nodes;
}

/// Operations a particle needs: a multiply-add for each node and component, Horner's rule for each weight, in 3D the
/// products of the weights of two axes.
template <class K, int D, int C>
constexpr double flops_per_particle() {
  return 2.0 * nodes_per_particle<K, D>() * C + 2.0 * D * K::support * Taps<K>::degree +
         (D == 3 ? K::support * K::support : 0);
}

/// The library at work on a cloud: placed once, or with the order to be found in every call.
template <class K, int D, class T, int C, bool placed>
struct LibraryRun {
  using Value = std::conditional_t<C == 1, T, Vec<C, T>>;

  explicit LibraryRun(std::shared_ptr<Lazy<Cloud<D, T>>> from) : cloud(from), mesh((*from)->lattice) {
    std::array<T*, C> first;
    for (int c = 0; c < C; ++c) {
      value[c].resize(mesh.size());
      first[c] = value[c].data();
    }
    values = Columns<C, T>(first, mesh.size());
    mesh.sample([](const Vec<D>& x) {
      Value result{};
      for (int c = 0; c < C; ++c) component(result, c) = static_cast<T>(std::sin(x[0] + c));
      return result;
    });
  }
  void operator()(Way way, int threads) {
    const OpenMP execution{threads};
    if constexpr (placed) {
      if (placement.size() == 0) placement.update(mesh.lattice(), (*cloud)->positions(), execution);
      if (way == Way::p2m) {
        interpolator.p2m(placement, (*cloud)->template strengths<C>(), mesh, execution);
      } else {
        interpolator.m2p(mesh, placement, values, execution);
      }
    } else if (way == Way::p2m) {
      interpolator.p2m((*cloud)->positions(), (*cloud)->template strengths<C>(), mesh, execution);
    } else {
      interpolator.m2p(mesh, (*cloud)->positions(), values, execution);
    }
  }

  std::shared_ptr<Lazy<Cloud<D, T>>> cloud;
  Field<Value, D> mesh;
  std::array<AlignedVector<T>, C> value;
  Columns<C, T> values;
  Interpolator<K> interpolator;
  Placement<K, D, T> placement;
};

/// A plain loop at work on a cloud.
template <CompiledBy compiler, class K, int D, class T>
struct PlainRun {
  using Loop = PlainLoop<compiler, K, D, T>;

  explicit PlainRun(std::shared_ptr<Lazy<Cloud<D, T>>> from) : cloud(from) {
    const auto nodes = static_cast<double>(Loop::nodes((*from)->lattice.nodes()[0]));
    mesh.assign(static_cast<std::size_t>(std::pow(nodes, D)), T(1));
    value.resize((*from)->lattice.size());
  }
  void operator()(Way way) {
    const Cloud<D, T>& from = **cloud;
    const std::ptrdiff_t n = from.lattice.nodes()[0];
    if (way == Way::p2m) {
      Loop::p2m(from.pointers(), from.strength[0].data(), value.size(), n, mesh.data());
    } else {
      Loop::m2p(from.pointers(), value.data(), value.size(), n, mesh.data());
    }
  }

  std::shared_ptr<Lazy<Cloud<D, T>>> cloud;
  AlignedVector<T> mesh;
  AlignedVector<T> value;
};

template <class K, int D, class T>
struct UserRun {
  explicit UserRun(std::shared_ptr<Lazy<Cloud<D, T>>> from)
      : cloud(from), mesh((*from)->lattice.size(), T(1)), value(mesh.size()) {
    int support = K::support;
    benchmark::DoNotOptimize(support);
    loop = std::make_unique<UserLoop<K, D, T>>((*from)->lattice, support);
  }
  void operator()(Way way) {
    const Cloud<D, T>& from = **cloud;
    if (way == Way::p2m) {
      loop->p2m(from.positions(), from.strength[0].data(), mesh.data());
    } else {
      loop->m2p(mesh.data(), from.positions(), value.data());
    }
  }

  std::shared_ptr<Lazy<Cloud<D, T>>> cloud;
  AlignedVector<T> mesh;
  AlignedVector<T> value;
  std::unique_ptr<UserLoop<K, D, T>> loop;
};

/// The contest of all variants of one kernel, dimension and way on one thread.
template <class K, int D>
class InterpolationContest {
 public:
  InterpolationContest(const char* kernel, Way way, const Options& options)
      : way_(way),
        options_(options),
        prefix_(detail::message(name(way), "/", kernel, "/", D, "D/")),
        particles_(std::pow(static_cast<double>(options.cells<D>()), D)) {}

  /// One scalar type; `everything`: also three components, random order and the loops it is compared with.
  template <class T, bool everything>
  std::size_t add() {
    const std::string scalar = prefix_ + scalar_name<T> + "/";
    const auto sorted = lazily<Cloud<D, T>>(options_.cells<D>(), Order::sorted);
    const std::size_t peak = add_peak<T>(scalar);
    const std::size_t one = add_library<T, 1, true>(scalar + "1/sorted", sorted, peak);
    if constexpr (everything) {
      const auto random = lazily<Cloud<D, T>>(options_.cells<D>(), Order::random);
      compare(add_library<T, 3, true>(scalar + "3/sorted", sorted, peak), "ratio_to_one_component", one);
      compare(add_library<T, 1, false>(scalar + "1/unplaced", sorted, peak), "ratio_to_sorted", one);
      compare(add_library<T, 1, false>(scalar + "1/random", random, peak), "ratio_to_sorted", one);
      compare(add_loop<PlainRun<CompiledBy::build, K, D, T>>(scalar + "1/plain_build", sorted), "ratio_to_library",
              one);
      if constexpr (PLAIN_LOOP_CLANG) {
        compare(add_loop<PlainRun<CompiledBy::clang, K, D, T>>(scalar + "1/plain_clang", sorted), "ratio_to_library",
                one);
      }
      compare(add_loop<UserRun<K, D, T>>(scalar + "1/user", sorted), "ratio_to_library", one);
    }
    return one;
  }
  void compare(std::size_t entrant, const char* what, std::size_t with) {
    contest_->count(entrant, what, [=](const auto& round) { return round[entrant] / round[with]; });
  }
  void enter() { Contest::enter(contest_, options_.rounds); }

 private:
  template <class T>
  std::size_t add_peak(const std::string& scalar) {
    const std::size_t steps = options_.peak_steps;
    const std::size_t peak = contest_->add(scalar + "peak", [=] { benchmark::DoNotOptimize(FmaPeak<T>::run(steps)); });
    const double flops = FmaPeak<T>::flops_per_step * static_cast<double>(steps);
    contest_->count(peak, "gflops", [=](const auto& round) { return 1e-9 * flops / round[peak]; });
    return peak;
  }
  template <class T, int C, bool placed>
  std::size_t add_library(const std::string& row, std::shared_ptr<Lazy<Cloud<D, T>>> cloud, std::size_t peak) {
    const auto run = lazily<LibraryRun<K, D, T, C, placed>>(cloud);
    const std::size_t i = contest_->add(row, [=, way = way_] { (**run)(way, 1); });
    add_rates(i);
    const double flops = particles_ * flops_per_particle<K, D, C>();
    const double peak_flops = FmaPeak<T>::flops_per_step * static_cast<double>(options_.peak_steps);
    contest_->count(i, "fraction_of_peak",
                    [=](const auto& round) { return flops / round[i] / (peak_flops / round[peak]); });
    return i;
  }
  template <class Run, class Source>
  std::size_t add_loop(const std::string& row, const Source& cloud) {
    const auto run = lazily<Run>(cloud);
    const std::size_t i = contest_->add(row, [=, way = way_] { (**run)(way); });
    add_rates(i);
    return i;
  }
  void add_rates(std::size_t i) {
    const double particles = particles_;
    contest_->count(i, "ns_per_particle", [=](const auto& round) { return 1e9 * round[i] / particles; });
    contest_->count(i, "node_updates_per_second",
                    [=](const auto& round) { return particles * nodes_per_particle<K, D>() / round[i]; });
  }

  Way way_;
  Options options_;
  std::string prefix_;
  double particles_;
  std::shared_ptr<Contest> contest_ = std::make_shared<Contest>(cpu_seconds);
};

/// Kernels in full detail: both scalar types, one and three components, both orders, plain loops.
template <class K, int D>
void enter_in_detail(const char* kernel, const Options& options) {
  for (const Way way : {Way::p2m, Way::m2p}) {
    InterpolationContest<K, D> contest(kernel, way, options);
    const std::size_t wide = contest.template add<double, true>();
    const std::size_t narrow = contest.template add<float, true>();
    contest.compare(narrow, "ratio_to_double", wide);
    contest.enter();
  }
}

template <class K>
void enter_briefly(const char* kernel, const Options& options) {
  for (const Way way : {Way::p2m, Way::m2p}) {
    InterpolationContest<K, 2> flat(kernel, way, options);
    flat.template add<double, false>();
    flat.enter();
    InterpolationContest<K, 3> deep(kernel, way, options);
    deep.template add<double, false>();
    deep.enter();
  }
}

/// One thread against two, beside arithmetic in which each thread does for itself what one thread does alone.
template <class K, int D>
void enter_threads(const char* kernel, Way way, const Options& options) {
  const auto contest = std::make_shared<Contest>(wall_seconds);
  const std::string prefix = detail::message("threads/", name(way), "/", kernel, "/", D, "D/");
  const auto cloud = lazily<Cloud<D, double>>(options.cells<D>(), Order::sorted);
  const auto run = lazily<LibraryRun<K, D, double, 1, true>>(cloud);
  const auto arithmetic = [steps = options.peak_steps](int threads) {
    for_each_piece(OpenMP{threads}, static_cast<std::size_t>(threads), 1,
                   [&](std::size_t, std::size_t) { benchmark::DoNotOptimize(FmaPeak<double>::run(steps)); });
  };
  const std::size_t sum_one = contest->add(prefix + "arithmetic/1", [=] { arithmetic(1); });
  const std::size_t sum_two = contest->add(prefix + "arithmetic/2", [=] { arithmetic(2); });
  const std::size_t one = contest->add(prefix + "library/1", [=] { (**run)(way, 1); });
  const std::size_t two = contest->add(prefix + "library/2", [=] { (**run)(way, 2); });
  const auto gain = [=](const auto& round) { return round[one] / round[two]; };
  const auto arithmetic_gain = [=](const auto& round) { return 2.0 * round[sum_one] / round[sum_two]; };
  contest->count(sum_two, "gain", arithmetic_gain);
  contest->count(two, "gain", gain);
  contest->count(two, "gain_over_arithmetic", [=](const auto& round) { return gain(round) / arithmetic_gain(round); });
  Contest::enter(contest, options.rounds);
}

/// Remeshing of particles that left the nodes of a 3D lattice by three shears one after another: a displacement that
/// keeps volume and whose inverse is known, so that the remeshed strengths have an exact value.
struct Shears {
  double amplitude;

  double shift(double x) const { return amplitude * std::sin(2.0 * std::numbers::pi * x); }
  Vec<3> operator()(Vec<3> x) const {
    x[0] += shift(x[1]);
    x[2] += shift(x[0]);
    x[1] += shift(x[2]);
    return x;
  }
  Vec<3> inverse(Vec<3> x) const {
    x[1] -= shift(x[2]);
    x[2] -= shift(x[0]);
    x[0] -= shift(x[1]);
    return x;
  }
};

double density(const Vec<3>& x) {
  double product = 1.0;
  for (int d = 0; d < 3; ++d) product *= std::exp(std::sin(2.0 * std::numbers::pi * x[d]));
  return product;
}

template <class K, class Strategy>
class RemeshRun {
 public:
  RemeshRun(std::ptrdiff_t cells, double displacement)
      : lattice_(Lattice<3>::periodic_box(Box<3>::cube(), cells)),
        shears_{displacement},
        start_(lattice_.size()),
        particles_(lattice_.size()),
        strength_(particles_.add<double>("strength")) {
    start_.add<double>("strength");
    for (std::size_t i = 0; i < lattice_.size(); ++i) {
      const Vec<3> x = lattice_.position(lattice_.node(i));
      start_.positions().set(i, lattice_.domain().wrap(shears_(x)));
      start_[strength_][i] = density(x);
    }
  }
  /// Puts the particles where they are before remeshing, into the same memory.
  void reset() {
    for (int d = 0; d < 3; ++d)
      std::ranges::copy(start_.positions().column(d), particles_.positions().column(d).begin());
    std::ranges::copy(start_[strength_], particles_[strength_].begin());
  }
  void operator()() { remesh_(particles_, lattice_, strength_); }
  /// Root mean square, relative.
  double error() const {
    double difference = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < lattice_.size(); ++i) {
      const double exact = density(shears_.inverse(lattice_.position(lattice_.node(i))));
      difference += std::pow(particles_[strength_][i] - exact, 2);
      size += exact * exact;
    }
    return std::sqrt(difference / size);
  }

 private:
  Lattice<3> lattice_;
  Shears shears_;
  Particles<3> start_;
  Particles<3> particles_;
  Attribute<double> strength_;
  Remesher<K, Strategy, Serial> remesh_;
};

template <class K>
void enter_remeshing(const char* kernel, const Options& options) {
  const std::ptrdiff_t cells = options.cells_3d;
  const double displacement = 2.0 / static_cast<double>(cells);
  const std::string prefix = detail::message("remesh/", kernel, "/3D/");
  const auto contest = std::make_shared<Contest>(cpu_seconds);
  const auto tensor = lazily<RemeshRun<K, Tensor>>(cells, displacement);
  const auto split = lazily<RemeshRun<K, Split>>(cells, displacement);
  const std::size_t one = contest->add(
      prefix + "tensor", [=] { (**tensor)(); }, [=] { (*tensor)->reset(); });
  const std::size_t other = contest->add(
      prefix + "split", [=] { (**split)(); }, [=] { (*split)->reset(); });
  const double particles = std::pow(static_cast<double>(cells), 3);
  for (const std::size_t i : {one, other}) {
    contest->count(i, "ns_per_particle", [=](const auto& round) { return 1e9 * round[i] / particles; });
  }
  contest->count(other, "speedup_over_tensor", [=](const auto& round) { return round[one] / round[other]; });
  Contest::enter(contest, options.rounds);
}

template <class K, class Strategy>
double remeshing_error(std::ptrdiff_t cells) {
  RemeshRun<K, Strategy> run(cells, 2.0 / static_cast<double>(cells));
  run.reset();
  run();
  return run.error();
}

template <class K>
void enter_remeshing_error(const char* kernel, const Options& options) {
  const std::string row = detail::message("remesh_error/", kernel, "/3D");
  benchmark::RegisterBenchmark(
      row.c_str(),
      [=](benchmark::State& state) {
        for (auto _ : state) {
          double tensor = 0.0;
          double split = 0.0;
          double ratio = 0.0;
          std::ptrdiff_t last = 0;
          for (const std::ptrdiff_t cells : options.error_cells) {
            const double refinement = last > 0 ? std::log(static_cast<double>(cells) / static_cast<double>(last)) : 0.0;
            const double tensor_before = std::exchange(tensor, remeshing_error<K, Tensor>(cells));
            const double split_before = std::exchange(split, remeshing_error<K, Split>(cells));
            ratio = split / tensor;
            state.counters[detail::message("tensor_", cells)] = tensor;
            state.counters[detail::message("split_", cells)] = split;
            if (last > 0) {
              state.counters["order_tensor"] = std::log(tensor_before / tensor) / refinement;
              state.counters["order_split"] = std::log(split_before / split) / refinement;
            }
            last = cells;
          }
          state.counters["split_error_over_tensor"] = ratio;
        }
      })
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
}

/// `smoke`: one kernel in 2D, so that a test of the program compiles in seconds.
template <bool smoke>
void enter_all(const Options& options) {
  if constexpr (smoke) {
    InterpolationContest<M4Prime, 2> contest("M4Prime", Way::p2m, options);
    contest.add<double, true>();
    contest.enter();
    enter_threads<M4Prime, 2>("M4Prime", Way::p2m, options);
    enter_remeshing_error<M4Prime>("M4Prime", options);
  } else {
    enter_in_detail<M4Prime, 2>("M4Prime", options);
    enter_in_detail<M4Prime, 3>("M4Prime", options);
    enter_in_detail<M6, 2>("M6", options);
    enter_in_detail<M6, 3>("M6", options);
    enter_briefly<Hat>("Hat", options);
    enter_briefly<M3>("M3", options);
    enter_briefly<M4>("M4", options);
    enter_briefly<Lambda<2, 2>>("Lambda22", options);
    enter_briefly<M6TriplePrime>("M6TriplePrime", options);
    enter_briefly<Lambda<4, 4>>("Lambda44", options);
    enter_briefly<Lambda<6, 4>>("Lambda64", options);
    enter_briefly<Lambda<8, 4>>("Lambda84", options);
    for (const Way way : {Way::p2m, Way::m2p}) {
      enter_threads<M4Prime, 2>("M4Prime", way, options);
      enter_threads<M4Prime, 3>("M4Prime", way, options);
      enter_threads<M6, 2>("M6", way, options);
      enter_threads<M6, 3>("M6", way, options);
    }
    enter_remeshing<M4Prime>("M4Prime", options);
    enter_remeshing<M6>("M6", options);
    enter_remeshing<Lambda<4, 4>>("Lambda44", options);
    enter_remeshing_error<M4Prime>("M4Prime", options);
    enter_remeshing_error<M6>("M6", options);
    enter_remeshing_error<Lambda<4, 4>>("Lambda44", options);
  }
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  bench::Options options;
  CLI::App app("Speed of P2M, M2P and remeshing. Options of Google Benchmark (--benchmark_...) are taken, too.");
  app.allow_extras();
  app.add_option("--rounds", options.rounds, "how often each thing is measured")->check(CLI::PositiveNumber);
  app.add_option("--cells-2d", options.cells_2d, "cells along an axis in 2D");
  app.add_option("--cells-3d", options.cells_3d, "cells along an axis in 3D");
  app.add_option("--error-cells", options.error_cells,
                 "cells along an axis for the error of remeshing, coarse to fine");
  app.add_option("--peak-steps", options.peak_steps, "length of the loop that measures the multiply-adds");
  CLI11_PARSE(app, argc, argv);

  std::vector<std::string> rest = app.remaining();
  rest.insert(rest.begin(), argv[0]);
  std::vector<char*> arguments;
  for (std::string& argument : rest) arguments.push_back(argument.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 1;
  benchmark::AddCustomContext("cells_2d", std::to_string(options.cells_2d));
  benchmark::AddCustomContext("cells_3d", std::to_string(options.cells_3d));
  benchmark::AddCustomContext("compiler", __VERSION__);
  bench::enter_all<BENCH_SMOKE != 0>(options);
  return benchmark::RunSpecifiedBenchmarks() > 0 ? 0 : 1;
}
