// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <cambium/levelset/surface.hpp>
#include <cambium/models/tumour/value_at.hpp>

#include "tumour/grow.hpp"
#include "tumour/verification.hpp"

namespace bench {
namespace {

using nlohmann::json;
using namespace cambium;
using Band = NarrowBand<double, 3>;

/// The ellipsoid of (11.72), e = 0.1, r = 2, without a core, at some times; bands until the first that it cannot reach.
std::vector<Band> grown(std::ptrdiff_t cells, const std::vector<double>& times, const TumourOptions& options) {
  Tumour<3, SemiImplicit> tumour(
      tumour_box<3>(cells, 12.0),
      [](const Vec<3>& x) { return std::sqrt(1.21 * x[0] * x[0] + x[1] * x[1] + 0.81 * x[2] * x[2]) - 2.0; },
      {.parameters = {.tension = options.tension_or(0.5)}}, OpenMP{options.threads});
  std::vector<Band> bands;
  for (const double time : times) {
    const json run = grow(tumour, time);
    std::printf("no necrosis  %4td cells of a box of 24  t = %.3f  volume %.4f  %d steps  %.1f s %s\n", cells,
                tumour.time(), run["volume"].get<double>(), run["steps"].get<int>(), run["seconds"].get<double>(),
                run.value("stopped", "").c_str());
    std::fflush(stdout);
    if (run.contains("stopped") || tumour.extinct()) break;
    bands.push_back(tumour.level_set().band());
  }
  return bands;
}
/// Largest distance of the interface of one band from that of another.
double distance(const Band& from, const Band& to) {
  double largest = 0.0;
  for (const auto& x : extract_surface(from).vertices) {
    largest = std::max(largest, std::abs(cambium::detail::value_at(to.values(), to, x)));
  }
  return largest;
}

}  // namespace

json verify_convergence(const TumourOptions& options) {
  const std::vector<double> times = options.smoke ? std::vector{0.1} : std::vector{0.5, 1.0, 1.5, 2.0};
  json runs = json::array();
  std::vector<Band> coarse;
  for (const auto n : options.cells_or({64, 96, 128})) {
    std::vector<Band> fine = grown(n, times, options);
    for (std::size_t k = 0; k < std::min(coarse.size(), fine.size()); ++k) {
      const double apart = std::max(distance(coarse[k], fine[k]), distance(fine[k], coarse[k]));
      std::printf("no necrosis  %4td cells and the lattice before  t = %.1f  interfaces %.4f apart\n", n, times[k],
                  apart);
      runs.push_back({{"scene", "convergence"}, {"cells", n}, {"time", times[k]}, {"apart", apart}});
    }
    std::fflush(stdout);
    coarse = std::move(fine);
  }
  return runs;
}

}  // namespace bench
