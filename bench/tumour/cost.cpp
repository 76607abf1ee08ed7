// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <malloc.h>
#include <memory>
#include <string>

#include <cambium/levelset/shapes/ball.hpp>

#include "support/pair.hpp"
#include "tumour/grow.hpp"
#include "tumour/verification.hpp"

namespace bench {
namespace {

using nlohmann::json;
using namespace cambium;

/// Bytes that the program has of the heap.
double heap_bytes() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}
/// Nodes nearer to the interface than the half width of the band.
template <class T>
double band_nodes(const T& tumour) {
  double nodes = 0.0;
  const auto& band = tumour.level_set().band();
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (const double phi : band.values().block(b)) nodes += band.in_band(phi) ? 1.0 : 0.0;
  }
  return nodes;
}
template <int D>
Ball<D> ball(double radius) {
  return {Vec<D>::constant(0.02), radius};
}

/// Seconds of the parts of a step, the least of several.
template <class T>
json time_steps(const char* name, std::ptrdiff_t cells, double radius, double pair, double fast_pair) {
  T tumour(tumour_box<3>(cells, 6.0), ball<3>(radius), {.parameters = {.tension = 1.0}}, OpenMP{1});
  constexpr int warm = 4, timed = 5;  // the first steps are short ones
  TumourTimes least;
  double step = 1e300;
  for (int k = 0; k < warm + timed; ++k) {
    const TumourTimes before = tumour.times();
    const double start = cpu_seconds();
    tumour.step();
    if (k < warm || cpu_seconds() - start >= step) continue;
    step = cpu_seconds() - start;
    const TumourTimes& after = tumour.times();
    least = {after.geometry - before.geometry, after.nutrient - before.nutrient, after.pressure - before.pressure,
             after.implicit - before.implicit, after.motion - before.motion};
  }
  std::printf(
      "cost %-28s %4td cells  R = %g  %.3f s a step, %.2f pairs (%.2f of the next fast size): geometry %.3f, nutrient "
      "%.3f, pressure %.3f, implicit %.3f, motion %.3f s\n",
      name, cells, radius, step, step / pair, step / fast_pair, least.geometry, least.nutrient, least.pressure,
      least.implicit, least.motion);
  std::fflush(stdout);
  return {{"scene", "cost"},
          {"policies", name},
          {"cells", cells},
          {"radius", radius},
          {"seconds", step},
          {"pair_seconds", pair},
          {"pairs", step / pair},
          {"fast_pairs", step / fast_pair},
          {"parts",
           {{"geometry", least.geometry},
            {"nutrient", least.nutrient},
            {"pressure", least.pressure},
            {"implicit", least.implicit},
            {"motion", least.motion}}}};
}

/// Bytes a node of the lattice and a node of the band: from balls of two radii, after two steps.
template <class T>
json measure_memory(const char* name, std::ptrdiff_t cells) {
  double bytes[2], nodes[2], all = 0.0;
  for (const int k : {0, 1}) {
    const double before = heap_bytes();
    const auto tumour = std::make_unique<T>(tumour_box<3>(cells, 6.0), ball<3>(k == 0 ? 1.5 : 4.0),
                                            typename T::Params{.parameters = {.tension = 1.0}}, OpenMP{1});
    for (int step = 0; step < 2; ++step) tumour->step();
    bytes[k] = heap_bytes() - before;
    nodes[k] = band_nodes(*tumour);
    all = static_cast<double>(tumour->lattice().size());
  }
  const double of_band = (bytes[1] - bytes[0]) / (nodes[1] - nodes[0]);
  const double of_lattice = (bytes[0] - of_band * nodes[0]) / all;
  std::printf("memory %-28s %4td cells  %.0f bytes a node of the lattice, %.0f a node of the band\n", name, cells,
              of_lattice, of_band);
  std::fflush(stdout);
  return {{"scene", "memory"},
          {"policies", name},
          {"cells", cells},
          {"bytes_per_node", of_lattice},
          {"bytes_per_band_node", of_band}};
}

}  // namespace

json measure_cost(const TumourOptions& options) {
  json runs = json::array();
  for (const auto n : options.cells_or({64, 128})) {
    const double pair = pair_seconds(2 * (n + 1)), fast_pair = pair_seconds(2 * n);
    std::printf("pair of %td^3: %.3f s, of %td^3: %.3f s\n", 2 * (n + 1), pair, 2 * n, fast_pair);
    for (const double radius : {2.0, 4.0}) {
      runs.push_back(time_steps<Tumour<3>>("AdamsBashforth", n, radius, pair, fast_pair));
      runs.push_back(time_steps<Tumour<3, SemiImplicit>>("SemiImplicit", n, radius, pair, fast_pair));
    }
    runs.push_back(
        time_steps<Tumour<3, SemiImplicit, ZeroOutside>>("SemiImplicit ZeroOutside", n, 2.0, pair, fast_pair));
  }
  const auto small = options.cells_or({64}).front();
  runs.push_back(measure_memory<Tumour<3>>("FreeSpace", small));
  runs.push_back(measure_memory<Tumour<3, SemiImplicit>>("FreeSpace SemiImplicit", small));
  runs.push_back(measure_memory<Tumour<3, Necrosis>>("FreeSpace Necrosis", small));
  runs.push_back(measure_memory<Tumour<3, Diffusing>>("FreeSpace Diffusing", small));
  runs.push_back(measure_memory<Tumour<3, ZeroOutside>>("ZeroOutside", small));
  return runs;
}

}  // namespace bench
