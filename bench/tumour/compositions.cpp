// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include <cambium/interface/jump_mayo.hpp>
#include <cambium/levelset/extension/by_pde.hpp>
#include <cambium/levelset/reinit/fast_marching.hpp>
#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/levelset/surface.hpp>

#include "tumour/boundary_integral.hpp"
#include "tumour/grow.hpp"
#include "tumour/verification.hpp"
#include "tumour/wave.hpp"

namespace bench {
namespace {

using nlohmann::json;
using namespace cambium;

/// V of the nodes next to the interface, continued off it by another extension, in the place of V at the closest point
/// of every node. Takes the place of a filter.
template <class X>
struct ExtendedBy {
  using Kind = tumour_kind::Filter;

  template <int D>
  class Method {
   public:
    explicit Method(const Lattice<D>& lattice) : from_(lattice), to_(lattice) {}
    void operator()(const NarrowBand<double, D>& band, Field<double, D, Sparse>& speed, const OpenMP& execution) {
      from_ = speed;
      for (std::size_t b = 0; b < from_.blocks(); ++b) {
        for (double& v : from_.block(b)) v = std::isnan(v) ? 0.0 : v;  // far from the interface
      }
      extend_(band, from_, to_, execution);
      for (std::size_t b = 0; b < speed.blocks(); ++b) {
        for (std::size_t i = 0; i < band.volume; ++i) {
          if (!std::isnan(speed.block(b)[i])) speed.block(b)[i] = to_.block(b)[i];
        }
      }
    }

   private:
    typename X::template Method<double, D> extend_{typename X::Params{}};
    Field<double, D, Sparse> from_, to_;
  };
};

constexpr double end = 0.1, wave_height = 0.1;

/// The share of the waves' height, see run(), that is left of the true interfaces.
double exact_share() {
  const BoundaryIntegral solver(64, {});
  const auto height = [&](const ClosedCurve& curve) {
    WaveFit fit;
    for (int j = 0; j < curve.x.size(); ++j) {
      fit.add(std::cos(4.0 * std::atan2(curve.y[j], curve.x[j])), std::hypot(curve.x[j], curve.y[j]), curve.speed[j]);
    }
    return fit.part();
  };
  double share = 0.0;
  for (const double delta : {wave_height, -wave_height}) {
    const auto start = equidistant(solver.grid(), [&](double theta) { return 2.0 + delta * std::cos(4.0 * theta); });
    share += 0.5 * height(solver.run(start, end, solver.stable_steps(start, end))) / height(start);
  }
  return share;
}

/// A disc, for R(0.1), and the waves r = 2 +- 0.1 cos(4 theta), for the share of their height that is left at t = 0.1:
/// by least squares over the interface, mean of both. \param share  what is exact
template <class T>
json run(const char* name, const char* kind, std::ptrdiff_t cells, const TumourOptions& options, double share) {
  const auto height = [](const T& tumour, const Wave<2>& wave) {
    WaveFit fit;
    const auto surface = extract_surface(tumour.level_set().band());
    for (const auto& segment : surface.elements) {
      const Vec<2> a = surface.vertices[segment[0]], b = surface.vertices[segment[1]];
      const Vec<2> x = (a + b) * 0.5;
      fit.add(wave(x), norm(x - wave.centre()), norm(b - a));
    }
    return fit.part();
  };
  const Wave<2> wave{4};
  double kept = 0.0, seconds = 0.0;
  int steps = 0, products = 0;
  std::string stopped;
  for (const double delta : {wave_height, -wave_height}) {
    T tumour(
        tumour_box<2>(cells, 6.0), [&](const Vec<2>& x) { return wave.shape(x, delta); },
        {.parameters = {.tension = 1.0}}, OpenMP{options.threads});
    const double first = height(tumour, wave);
    const json result = grow(tumour, end);
    kept += 0.5 * height(tumour, wave) / first;
    seconds += 0.5 * result["seconds"].template get<double>();
    steps = result["steps"].template get<int>();
    products = result["iterations"].template get<int>();
    if (result.contains("stopped")) stopped = result["stopped"].template get<std::string>();
  }
  T disc(tumour_box<2>(cells, 6.0), Ball<2>(wave.centre(), 2.0), {.parameters = {.tension = 1.0}},
         OpenMP{options.threads});
  const json result = grow(disc, end);
  const double radius = std::sqrt(result["volume"].template get<double>() / std::numbers::pi) / 2.35800262640 - 1.0;
  const double wave_error = kept / share - 1.0;
  std::printf("composition %-10s %-24s %4td cells  R off by %9.2e  wave by %9.2e  %4d steps %5d products %7.2f s %s\n",
              kind, name, cells, radius, wave_error, steps, products, seconds, stopped.c_str());
  std::fflush(stdout);
  return {{"scene", "composition"}, {"kind", kind},           {"name", name},
          {"cells", cells},         {"radius_error", radius}, {"wave_error", wave_error},
          {"steps", steps},         {"products", products},   {"seconds", seconds},
          {"stopped", stopped}};
}

}  // namespace

json compare_compositions(const TumourOptions& options) {
  json runs = json::array();
  const double share = exact_share();
  for (const auto n : options.cells_or({32, 48, 64, 96, 128})) {
    runs.push_back(run<Tumour<2, SemiImplicit>>("SemiImplicit", "stepper", n, options, share));
    if (n <= 64) {
      runs.push_back(run<Tumour<2>>("AdamsBashforth", "stepper", n, options, share));
      runs.push_back(run<Tumour<2, Heun>>("Heun", "stepper", n, options, share));
    }
    runs.push_back(run<Tumour<2, SemiImplicit, ReinitialiseBy<FastMarching<>>>>("FastMarching", "reinitialisation", n,
                                                                                options, share));
    runs.push_back(run<Tumour<2, SemiImplicit, GaussianFilter<1>>>("GaussianFilter<1>", "filter", n, options, share));
    runs.push_back(run<Tumour<2, SemiImplicit, GaussianFilter<2>>>("GaussianFilter<2>", "filter", n, options, share));
    runs.push_back(run<Tumour<2, SemiImplicit, ExtendedBy<ByPde<>>>>("ByPde", "extension", n, options, share));
    runs.push_back(run<Tumour<2, SemiImplicit, BasicFreeSpace<JumpOfValue>>>("JumpOfValue", "jump", n, options, share));
  }
  return runs;
}

}  // namespace bench
