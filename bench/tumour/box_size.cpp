// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>

#include "tumour/curve_distance.hpp"
#include "tumour/grow.hpp"
#include "tumour/verification.hpp"

namespace bench {
namespace {

using cambium::Vec;
using nlohmann::json;

/// The ellipse (11.72) in the plane with little tension; cells along an axis and half the length of the box.
std::vector<Polygon> interface_at(std::ptrdiff_t cells, double half, double end, const TumourOptions& options) {
  cambium::Tumour<2, cambium::SemiImplicit> tumour(
      tumour_box<2>(cells, half), [](const Vec<2>& x) { return std::hypot(1.1 * x[0], 0.9 * x[1]) - 2.0; },
      {.parameters = {.tension = options.tension_or(1.0)}}, cambium::OpenMP{options.threads});
  const json result = grow(tumour, end);
  std::printf("box of %g, %td cells: area %.6f at t = %.4f  %.1f s\n", 2.0 * half, cells,
              result["volume"].get<double>(), tumour.time(), result["seconds"].get<double>());
  std::fflush(stdout);
  return interface_of(tumour.level_set().band());
}

}  // namespace

json verify_box(const TumourOptions& options) {
  json runs = json::array();
  const double end = options.end_or(4.0);
  for (const auto n : options.cells_or({128})) {
    const double h = 24.0 / static_cast<double>(n);
    const double distance = hausdorff(interface_at(n, 12.0, end, options), interface_at(2 * n, 24.0, end, options)) / h;
    std::printf("box     24 and 48, h = %.4f: interfaces at t = %g are %.2e h apart\n", h, end, distance);
    runs.push_back({{"scene", "box"}, {"cells", n}, {"time", end}, {"spacings_apart", distance}});
  }
  return runs;
}

}  // namespace bench
